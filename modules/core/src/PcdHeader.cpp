#include "PcdHeader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <map>

#include "CloudText.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

/** By the values of SIZE and TYPE. */
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

/** Lines that some of them lack have defaults. */
const std::array<std::string, 6> kVersions = {"0.5", ".5", "0.6", ".6", "0.7", ".7"};

std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/** More points, or more numbers in a field, are damage; the product of any two stays below
 * 2^64. */
constexpr double kMaxOfAnything = 1e9;

}  // namespace

/** Collects the lines, each a keyword and its values, and then makes sense of them. */
class PcdHeaderReader {
 public:
  PcdHeaderReader(std::istream& file, const std::string& path) : text_(file, path) {}

  PcdHeader header() {
    readLines();
    if (has("VERSION") &&
        std::find(kVersions.begin(), kVersions.end(), one("VERSION")) == kVersions.end())
      fail("VERSION", "version '" + one("VERSION") + "' is not read, only 0.5 to 0.7");
    header_.lines = text_.line();
    addFields();
    addPoints();
    addViewpoint();
    const auto data = kData.find(one("DATA"));
    if (data == kData.end()) fail("DATA", "'" + one("DATA") + "' is not a known kind of data");
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
    std::vector<std::string> words;
    while (text_.next(words)) {
      if (words[0][0] == '#') {
        takeOffset(words, header_.offset);
        continue;
      }
      // The name of FIELDS before version 0.7.
      const std::string keyword = words[0] == "COLUMNS" ? "FIELDS" : words[0];
      if (std::find(kKeywords.begin(), kKeywords.end(), keyword) == kKeywords.end())
        text_.fail("is not a line of a PCD header");
      Line& line = lines_[keyword];
      if (line.number != 0) text_.fail(keyword + " appears twice");
      line.number = text_.line();
      line.values.assign(words.begin() + 1, words.end());
      if (keyword == "DATA") return;
    }
    text_.fail("the file ends within its header");
  }

  const std::vector<std::string>& all(const std::string& keyword) const {
    const auto found = lines_.find(keyword);
    if (found == lines_.end()) text_.fail("the header has no " + keyword);
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
      fail(keyword, "'" + text + "' is not a count");
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
    for (size_t i = 0; i < names.size(); ++i) {
      const std::string size = has("SIZE") ? perField("SIZE")[i] : "4";
      const std::string type = has("TYPE") ? perField("TYPE")[i] : "F";
      const auto scalar = kScalars.find(size + type);
      if (scalar == kScalars.end())
        fail(has("TYPE") ? "TYPE" : "SIZE", "there is no type " + type + " of " + size + " bytes");
      const size_t count = has("COUNT") ? number("COUNT", perField("COUNT")[i]) : 1;
      header_.fields.push_back({names[i], scalar->second, count});
    }
  }

  void addPoints() {
    const std::string width = has("WIDTH") || !has("POINTS") ? "WIDTH" : "POINTS";
    header_.points =
        number(width, one(width)) * (has("HEIGHT") ? number("HEIGHT", one("HEIGHT")) : 1);
    if (has("POINTS") && number("POINTS", one("POINTS")) != header_.points)
      fail("POINTS", "is not WIDTH times HEIGHT, " + std::to_string(header_.points) +
                         ": correct whichever is wrong");
  }

  void addViewpoint() {
    if (!has("VIEWPOINT")) return;
    if (all("VIEWPOINT").size() != 7) fail("VIEWPOINT", "needs x y z qw qx qy qz");
    for (int axis = 0; axis < 3; ++axis)
      if (!parseDouble(all("VIEWPOINT")[axis], header_.viewpoint[axis]) ||
          !std::isfinite(header_.viewpoint[axis]))
        fail("VIEWPOINT", "is not a position");
  }

  size_t placeOf(const std::string& name) const {
    const auto& fields = header_.fields;
    const auto found = std::find_if(fields.begin(), fields.end(), [&](const PcdField& field) {
      return lowerCase(field.name) == name;
    });
    if (found == fields.end()) fail("FIELDS", "the points have no '" + name + "'");
    if (found->count != 1) fail("COUNT", "'" + name + "' must be one number");
    return static_cast<size_t>(found - fields.begin());
  }

  bool has(const std::string& keyword) const { return lines_.count(keyword) != 0; }

  [[noreturn]] void fail(const std::string& keyword, const std::string& what) const {
    text_.failAt(lines_.at(keyword).number, keyword + ": " + what);
  }

  CloudText text_;
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
