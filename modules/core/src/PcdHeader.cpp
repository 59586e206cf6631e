#include "PcdHeader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

/** By what SIZE and TYPE say. */
const std::map<std::string, Scalar> kScalars = {
    {"1I", Scalar::of<int8_t>()},   {"1U", Scalar::of<uint8_t>()},  {"2I", Scalar::of<int16_t>()},
    {"2U", Scalar::of<uint16_t>()}, {"4I", Scalar::of<int32_t>()},  {"4U", Scalar::of<uint32_t>()},
    {"8I", Scalar::of<int64_t>()},  {"8U", Scalar::of<uint64_t>()}, {"4F", Scalar::of<float>()},
    {"8F", Scalar::of<double>()}};

const std::map<std::string, PcdData> kData = {{"ascii", PcdData::kAscii},
                                              {"binary", PcdData::kBinary},
                                              {"binary_compressed", PcdData::kBinaryCompressed}};

const std::array<std::string, 10> kKeywords = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                               "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/** Beyond this a number of points or of a field's numbers is damage; products of a few stay below
 * 2^64. */
constexpr double kMaxOfAnything = 1e9;

}  // namespace

/** Collects the lines, each a keyword and its values, and then makes sense of them. */
class PcdHeaderReader {
 public:
  PcdHeaderReader(std::istream& file, const std::string& path) : file_(file), path_(path) {}

  PcdHeader header() {
    readLines();
    if (const auto& version = one("VERSION"); version != "0.7" && version != ".7")
      fail("VERSION", "version '" + version + "' is not read, only 0.7");
    header_.lines = line_;
    addFields();
    addPoints();
    addViewpoint();
    const auto data = kData.find(one("DATA"));
    if (data == kData.end()) fail("DATA", "'" + one("DATA") + "' is no kind of data");
    header_.data = data->second;
    for (size_t axis = 0; axis < 3; ++axis)
      header_.xyz_[axis] = placeOf(std::string(1, "xyz"[axis]));
    return header_;
  }

 private:
  struct Line {
    size_t number = 0;
    std::vector<std::string> values;
  };

  void readLines() {
    std::string text;
    while (std::getline(file_, text)) {
      ++line_;
      std::istringstream words(text);
      std::string keyword, value;
      if (!(words >> keyword) || keyword[0] == '#') continue;
      if (std::find(kKeywords.begin(), kKeywords.end(), keyword) == kKeywords.end())
        failAt(line_, "is no line of a PCD header");
      Line& line = lines_[keyword];
      if (line.number != 0) failAt(line_, keyword + " is there twice");
      line.number = line_;
      while (words >> value) line.values.push_back(value);
      if (keyword == "DATA") return;
    }
    failAt(line_, "the file ends within its header");
  }

  const std::vector<std::string>& all(const std::string& keyword) const {
    const auto found = lines_.find(keyword);
    if (found == lines_.end()) failAt(line_, "the header has no " + keyword);
    return found->second.values;
  }

  const std::string& one(const std::string& keyword) const {
    if (all(keyword).size() != 1) fail(keyword, "needs one value");
    return all(keyword).front();
  }

  size_t number(const std::string& keyword, const std::string& text) const {
    double value = 0;
    if (!parseDouble(text, value) || !(value >= 0 && value <= kMaxOfAnything) ||
        value != std::floor(value))
      fail(keyword, "'" + text + "' is no number of anything");
    return static_cast<size_t>(value);
  }

  /** The values of a line that has one for each field. */
  const std::vector<std::string>& perField(const std::string& keyword) const {
    if (all(keyword).size() != all("FIELDS").size())
      fail(keyword, "needs as many values as FIELDS has");
    return all(keyword);
  }

  void addFields() {
    const auto& names = all("FIELDS");
    const auto &sizes = perField("SIZE"), &types = perField("TYPE");
    for (size_t i = 0; i < names.size(); ++i) {
      const auto scalar = kScalars.find(sizes[i] + types[i]);
      if (scalar == kScalars.end())
        fail("TYPE", "there is no type " + types[i] + " of " + sizes[i] + " bytes");
      const size_t count = has("COUNT") ? number("COUNT", perField("COUNT")[i]) : 1;
      header_.fields.push_back({names[i], scalar->second, count});
    }
  }

  void addPoints() {
    header_.points = number("WIDTH", one("WIDTH")) * number("HEIGHT", one("HEIGHT"));
    if (has("POINTS") && number("POINTS", one("POINTS")) != header_.points)
      fail("POINTS", "is not WIDTH times HEIGHT");
  }

  void addViewpoint() {
    if (!has("VIEWPOINT")) return;
    if (all("VIEWPOINT").size() != 7) fail("VIEWPOINT", "needs x y z qw qx qy qz");
    for (int axis = 0; axis < 3; ++axis)
      if (!parseDouble(all("VIEWPOINT")[axis], header_.viewpoint[axis]) ||
          !std::isfinite(header_.viewpoint[axis]))
        fail("VIEWPOINT", "is no place");
  }

  size_t placeOf(const std::string& name) const {
    const auto& fields = header_.fields;
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&](const PcdField& field) { return field.name == name; });
    if (found == fields.end()) fail("FIELDS", "the points have no '" + name + "'");
    if (found->count != 1) fail("COUNT", "'" + name + "' must be one number");
    return static_cast<size_t>(found - fields.begin());
  }

  bool has(const std::string& keyword) const { return lines_.count(keyword) != 0; }

  [[noreturn]] void fail(const std::string& keyword, const std::string& what) const {
    failAt(lines_.at(keyword).number, keyword + ": " + what);
  }
  [[noreturn]] void failAt(size_t line, const std::string& what) const {
    throw std::runtime_error(path_ + ":" + std::to_string(line) + ": " + what);
  }

  std::istream& file_;
  const std::string& path_;
  size_t line_ = 0;
  std::map<std::string, Line> lines_;
  PcdHeader header_;
};

PcdHeader PcdHeader::read(std::istream& file, const std::string& path) {
  return PcdHeaderReader(file, path).header();
}

size_t PcdHeader::bytesPerPoint() const {
  size_t bytes = 0;
  for (const PcdField& field : fields) bytes += field.bytes();
  return bytes;
}

size_t PcdHeader::numbersPerPoint() const {
  size_t numbers = 0;
  for (const PcdField& field : fields) numbers += field.count;
  return numbers;
}

}  // namespace lamp
