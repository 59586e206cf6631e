#include "lamp/core/PlyVertices.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "Scalar.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

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

}  // namespace

PlyVertices::PlyVertices(const std::string& path) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + path + "': there is no such file");
  readHeader(file);
  data_ = file.tellg();
  checkSize();
}

/** A damaged header may announce more vertices than any memory has room for. */
void PlyVertices::checkSize() const {
  const size_t least_bytes = binary_ ? stride_ : 2 * properties_.size();
  const size_t there = std::filesystem::file_size(path_) - static_cast<size_t>(data_) + 1;
  if (count_ > there / least_bytes)
    fail("is too short for the " + std::to_string(count_) + " vertices that its header announces");
}

void PlyVertices::readHeader(std::istream& file) {
  std::string line, element;
  if (!std::getline(file, line) || line.substr(0, 3) != "ply") fail("is no PLY file");
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line == "end_header") {
      if (properties_.empty()) fail("has no vertices");
      return;
    }
    takeHeaderLine(line, element);
  }
  fail("ends within its header");
}

void PlyVertices::takeHeaderLine(const std::string& line, std::string& element) {
  std::istringstream words(line);
  std::string keyword, first, second;
  words >> keyword >> first >> second;
  if (keyword == "format") {
    binary_ = first == "binary_little_endian";
    if (!binary_ && first != "ascii") fail("has the format '" + first + "', which is not read");
  } else if (keyword == "element") {
    if (first == "vertex") {
      double count = 0;
      if (!element.empty()) fail("has elements before its vertices");
      if (!parseDouble(second, count) || !(count >= 0 && count < 1e15))
        fail("has no number of vertices");
      count_ = static_cast<size_t>(count);
    }
    element = first;
  } else if (keyword == "property" && element == "vertex") {
    addProperty(first, second);
  }
}

void PlyVertices::addProperty(const std::string& type, const std::string& name) {
  const auto scalar = kScalars.find(type);
  if (scalar == kScalars.end()) fail("has vertices with a property of type '" + type + "'");
  properties_.push_back({name, stride_, scalar->second.value});
  stride_ += scalar->second.size;
}

bool PlyVertices::has(const std::string& property) const {
  return std::any_of(properties_.begin(), properties_.end(),
                     [&](const Property& p) { return p.name == property; });
}

std::vector<size_t> PlyVertices::placesOf(const std::vector<std::string>& properties) const {
  std::vector<size_t> places;
  for (const std::string& name : properties) {
    const auto found = std::find_if(properties_.begin(), properties_.end(),
                                    [&](const Property& p) { return p.name == name; });
    if (found == properties_.end()) fail("has vertices without '" + name + "'");
    places.push_back(static_cast<size_t>(found - properties_.begin()));
  }
  return places;
}

bool PlyVertices::readVertex(std::istream& file, std::vector<double>& values) const {
  if (binary_) {
    thread_local std::vector<char> bytes;
    bytes.resize(stride_);
    if (!file.read(bytes.data(), static_cast<std::streamsize>(stride_))) return false;
    for (size_t i = 0; i < values.size(); ++i)
      values[i] = properties_[i].value(bytes.data() + properties_[i].offset);
    return true;
  }
  std::string word;
  for (double& value : values)
    if (!(file >> word) || !parseDouble(word, value)) return false;
  return true;
}

void PlyVertices::read(const std::vector<std::string>& properties,
                       const std::function<void(const double*)>& take, NotFinite not_finite) const {
  const std::vector<size_t> places = placesOf(properties);
  std::ifstream file(path_, std::ios::binary);
  file.seekg(data_);
  std::vector<double> values(properties_.size()), taken(places.size());
  for (size_t i = 0; i < count_; ++i) {
    if (!readVertex(file, values))
      fail("ends or is malformed at vertex " + std::to_string(i + 1) + " of " +
           std::to_string(count_));
    for (size_t k = 0; k < places.size(); ++k) {
      taken[k] = values[places[k]];
      if (not_finite == NotFinite::kRefuse && !std::isfinite(taken[k]))
        fail("has a value that is not finite in vertex " + std::to_string(i + 1));
    }
    take(taken.data());
  }
}

void PlyVertices::fail(const std::string& what) const {
  throw std::runtime_error("'" + path_ + "' " + what);
}

}  // namespace lamp
