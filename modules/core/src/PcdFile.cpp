#include "PcdFile.h"

#include <lzf.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

/** A reference of LZF takes 3 bytes and stands for at most 264: no data grow more. */
constexpr size_t kMaxGrowth = 88;

/** Where the values of each axis begin, if each field has `elements` values of `count` numbers. */
std::array<size_t, 3> offsetsOf(const PcdHeader& header, size_t elements,
                                size_t (*size)(const PcdField&)) {
  std::array<size_t, 3> offsets{};
  for (size_t axis = 0; axis < 3; ++axis)
    for (size_t i = 0; i < header.xyz()[axis]; ++i)
      offsets[axis] += elements * size(header.fields[i]);
  return offsets;
}

size_t bytesOf(const PcdField& field) {
  return field.bytes();
}
size_t numbersOf(const PcdField& field) {
  return field.count;
}

}  // namespace

PcdFile::PcdFile(const std::string& path) : path_(path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + path + "': there is no such file");
  header_ = PcdHeader::read(file, path);
  data_ = file.tellg();
  data_bytes_ = static_cast<size_t>(std::filesystem::file_size(path)) - static_cast<size_t>(data_);
  checkSize();
}

/** A damaged header may announce more points than any memory has room for. */
void PcdFile::checkSize() const {
  const size_t least_bytes =
      header_.data == PcdData::kAscii ? 2 * header_.numbersPerPoint() : header_.bytesPerPoint();
  // The last line of a text may lack its end.
  const size_t there = header_.data == PcdData::kAscii    ? data_bytes_ + 1
                       : header_.data == PcdData::kBinary ? data_bytes_
                                                          : data_bytes_ * kMaxGrowth;
  if (header_.points > there / least_bytes)
    fail("is too short for the " + std::to_string(header_.points) +
         " points that its header announces");
}

void PcdFile::readXyz(const Take& take) const {
  std::ifstream file(path_, std::ios::binary);
  file.seekg(data_);
  switch (header_.data) {
    case PcdData::kAscii:
      return readAscii(file, take);
    case PcdData::kBinary:
      return readBinary(file, take);
    case PcdData::kBinaryCompressed:
      return readCompressed(file, take);
  }
}

void PcdFile::readAscii(std::istream& file, const Take& take) const {
  const auto places = offsetsOf(header_, 1, numbersOf);
  std::vector<std::string> words(header_.numbersPerPoint());
  std::string line;
  for (size_t i = 0, number = header_.lines + 1; i < header_.points; ++number) {
    if (!std::getline(file, line))
      fail("ends after " + std::to_string(i) + " of " + std::to_string(header_.points) + " points");
    std::istringstream text(line);
    if ((text >> std::ws).eof()) continue;
    std::string rest;
    bool good = true;
    for (std::string& word : words) good = good && text >> word;
    double xyz[3] = {};
    for (int axis = 0; axis < 3; ++axis) good = good && parseDouble(words[places[axis]], xyz[axis]);
    if (!good || text >> rest)
      throw std::runtime_error(path_ + ":" + std::to_string(number) + ": is no point of " +
                               std::to_string(words.size()) + " numbers");
    take(xyz);
    ++i;
  }
}

void PcdFile::readBinary(std::istream& file, const Take& take) const {
  const auto offsets = offsetsOf(header_, 1, bytesOf);
  std::vector<char> point(header_.bytesPerPoint());
  for (size_t i = 0; i < header_.points; ++i) {
    if (!file.read(point.data(), static_cast<std::streamsize>(point.size())))
      fail("cannot be read at point " + std::to_string(i + 1));
    double xyz[3];
    for (int axis = 0; axis < 3; ++axis)
      xyz[axis] = header_.fields[header_.xyz()[axis]].scalar.value(&point[offsets[axis]]);
    take(xyz);
  }
}

/** All values of the first field come first, then all of the next one. */
void PcdFile::readCompressed(std::istream& file, const Take& take) const {
  if (header_.points == 0) return;
  const auto offsets = offsetsOf(header_, header_.points, bytesOf);
  const std::string bytes = decompressed(file);
  for (size_t i = 0; i < header_.points; ++i) {
    double xyz[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Scalar& scalar = header_.fields[header_.xyz()[axis]].scalar;
      xyz[axis] = scalar.value(&bytes[offsets[axis] + i * scalar.size]);
    }
    take(xyz);
  }
}

std::string PcdFile::decompressed(std::istream& file) const {
  uint32_t sizes[2] = {};  // compressed and not
  if (!file.read(reinterpret_cast<char*>(sizes), sizeof sizes)) fail("ends before its points");
  if (sizes[0] > data_bytes_ - sizeof sizes)
    fail("ends within its points: they take " + std::to_string(sizes[0]) + " bytes, " +
         std::to_string(data_bytes_ - sizeof sizes) + " are there");
  if (sizes[1] != header_.points * header_.bytesPerPoint())
    fail("holds " + std::to_string(sizes[1]) + " bytes of points, its header announces " +
         std::to_string(header_.points * header_.bytesPerPoint()));
  std::string packed(sizes[0], '\0'), bytes(sizes[1], '\0');
  file.read(packed.data(), static_cast<std::streamsize>(packed.size()));
  if (!file || lzf_decompress(packed.data(), sizes[0], bytes.data(), sizes[1]) != sizes[1])
    fail("has damaged points: they do not unpack");
  return bytes;
}

void PcdFile::fail(const std::string& what) const {
  throw std::runtime_error("'" + path_ + "' " + what);
}

}  // namespace lamp
