#include "PlyHeader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "CloudText.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

using Words = std::vector<std::string>;

/** PLY has an old and a new name for each type. */
const std::map<std::string, Scalar> kScalars = {
    {"char", Scalar::of<int8_t>()},     {"int8", Scalar::of<int8_t>()},
    {"uchar", Scalar::of<uint8_t>()},   {"uint8", Scalar::of<uint8_t>()},
    {"short", Scalar::of<int16_t>()},   {"int16", Scalar::of<int16_t>()},
    {"ushort", Scalar::of<uint16_t>()}, {"uint16", Scalar::of<uint16_t>()},
    {"int", Scalar::of<int32_t>()},     {"int32", Scalar::of<int32_t>()},
    {"uint", Scalar::of<uint32_t>()},   {"uint32", Scalar::of<uint32_t>()},
    {"float", Scalar::of<float>()},     {"float32", Scalar::of<float>()},
    {"double", Scalar::of<double>()},   {"float64", Scalar::of<double>()}};

const std::map<std::string, PlyData> kData = {{"ascii", PlyData::kAscii},
                                              {"binary_little_endian", PlyData::kLittleEndian},
                                              {"binary_big_endian", PlyData::kBigEndian}};

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::istream& file, const std::string& name) : text_(file, name) {}

  PlyHeader header() {
    Words words;
    if (!text_.next(words) || words[0] != "ply") text_.failAt(1, "is not a PLY file");
    while (text_.next(words) && words[0] != "end_header") take(words);
    if (words.empty() || words[0] != "end_header") text_.fail("the file ends within its header");
    if (!has_data_) text_.fail("the header has no 'format'");
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(),
                                     [](const PlyElement& e) { return e.name == "vertex"; });
    if (vertex == header_.elements.end() || vertex->properties.empty())
      text_.fail("the file has no vertices");
    header_.vertices = static_cast<size_t>(vertex - header_.elements.begin());
    header_.lines = text_.line();
    return std::move(header_);
  }

 private:
  void take(const Words& words) {
    if (words[0] == "format")
      takeFormat(words);
    else if (words[0] == "element")
      takeElement(words);
    else if (words[0] == "property")
      takeProperty(words);
    else if (words[0] == "comment")
      takeOffset(words, header_.offset);
    else if (words[0] != "obj_info")
      text_.fail("'" + words[0] + "' starts no line of a PLY header");
  }

  void takeFormat(const Words& words) {
    const auto data = kData.find(words.size() > 1 ? words[1] : "");
    if (data == kData.end()) text_.fail("the format must be ascii or binary, of either byte order");
    header_.data = data->second;
    has_data_ = true;
  }

  void takeElement(const Words& words) {
    if (words.size() < 3) text_.fail("an element needs a name and a number");
    const double count = text_.number(words[2]);
    if (!(count >= 0 && count < 1e15 && count == std::floor(count)))
      text_.fail("'" + words[2] + "' is not a number of elements");
    header_.elements.push_back({words[1], static_cast<size_t>(count), {}});
  }

  void takeProperty(const Words& words) {
    if (header_.elements.empty()) text_.fail("a property stands before all elements");
    const bool is_list = words.size() > 1 && words[1] == "list";
    if (words.size() < (is_list ? 5 : 3)) text_.fail("a property needs a type and a name");
    PlyProperty property{words[is_list ? 4 : 2], scalarOf(words[is_list ? 3 : 1]), std::nullopt};
    if (is_list) property.length = scalarOf(words[2]);
    header_.elements.back().properties.push_back(std::move(property));
  }

  const Scalar& scalarOf(const std::string& type) const {
    const auto scalar = kScalars.find(type);
    if (scalar == kScalars.end()) text_.fail("there is no type '" + type + "'");
    return scalar->second;
  }

  CloudText text_;
  bool has_data_ = false;
  PlyHeader header_;
};

}  // namespace

bool PlyElement::hasLists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const PlyProperty& property) { return property.length.has_value(); });
}

size_t PlyElement::bytes() const {
  size_t sum = 0;
  for (const PlyProperty& property : properties)
    sum += property.length ? property.length->size : property.scalar.size;
  return sum;
}

PlyHeader PlyHeader::read(std::istream& file, const std::string& name) {
  return PlyHeaderReader(file, name).header();
}

}  // namespace lamp
