#include "PcdFile.h"

#include <lzf.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "CloudText.h"
#include "lamp/core/Files.h"

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

PcdFile::PcdFile(const std::string& path) : PcdFile(openedToRead(path), path) {}

PcdFile::PcdFile(std::unique_ptr<std::istream> file, std::string name)
    : file_(std::move(file)),
      name_(std::move(name)),
      header_(PcdHeader::read(*file_, name_)),
      data_(file_->tellg()) {
  file_->clear();
  file_->seekg(0, std::ios::end);
  data_bytes_ = static_cast<size_t>(std::max<std::streamoff>(0, file_->tellg() - data_));
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
  file_->clear();
  file_->seekg(data_);
  switch (header_.data) {
    case PcdData::kAscii:
      return readAscii(take);
    case PcdData::kBinary:
      return readBinary(take);
    case PcdData::kBinaryCompressed:
      return readCompressed(take);
  }
}

void PcdFile::readAscii(const Take& take) const {
  const auto places = offsetsOf(header_, 1, numbersOf);
  const size_t expected = header_.numbersPerPoint();
  CloudText text(*file_, name_, header_.lines);
  std::vector<std::string> words;
  for (size_t i = 0; i < header_.points; ++i) {
    if (!text.next(words))
      fail("ends after " + std::to_string(i) + " of " + std::to_string(header_.points) + " points");
    if (words.size() != expected)
      text.fail("is not a point of " + std::to_string(expected) + " numbers");
    double xyz[3];
    for (int axis = 0; axis < 3; ++axis) xyz[axis] = text.number(words[places[axis]]);
    take(xyz);
  }
}

void PcdFile::readBinary(const Take& take) const {
  const auto offsets = offsetsOf(header_, 1, bytesOf);
  std::vector<char> point(header_.bytesPerPoint());
  for (size_t i = 0; i < header_.points; ++i) {
    if (!file_->read(point.data(), static_cast<std::streamsize>(point.size())))
      fail("cannot be read at point " + std::to_string(i + 1));
    double xyz[3];
    for (int axis = 0; axis < 3; ++axis)
      xyz[axis] = header_.fields[header_.xyz()[axis]].scalar.value(&point[offsets[axis]]);
    take(xyz);
  }
}

/** All values of the first field come first, then all of the next one. */
void PcdFile::readCompressed(const Take& take) const {
  if (header_.points == 0) return;
  const auto offsets = offsetsOf(header_, header_.points, bytesOf);
  const std::string bytes = decompressed();
  for (size_t i = 0; i < header_.points; ++i) {
    double xyz[3];
    for (int axis = 0; axis < 3; ++axis) {
      const Scalar& scalar = header_.fields[header_.xyz()[axis]].scalar;
      xyz[axis] = scalar.value(&bytes[offsets[axis] + i * scalar.size]);
    }
    take(xyz);
  }
}

std::string PcdFile::decompressed() const {
  uint32_t sizes[2] = {};  // compressed and not
  if (!file_->read(reinterpret_cast<char*>(sizes), sizeof sizes)) fail("ends before its points");
  if (sizes[0] > data_bytes_ - sizeof sizes)
    fail("ends within its points: they take " + std::to_string(sizes[0]) + " bytes, " +
         std::to_string(data_bytes_ - sizeof sizes) + " are there");
  if (sizes[1] != header_.points * header_.bytesPerPoint())
    fail("holds " + std::to_string(sizes[1]) + " bytes of points, its header announces " +
         std::to_string(header_.points * header_.bytesPerPoint()));
  std::string packed(sizes[0], '\0'), bytes(sizes[1], '\0');
  file_->read(packed.data(), static_cast<std::streamsize>(packed.size()));
  if (!*file_ || lzf_decompress(packed.data(), sizes[0], bytes.data(), sizes[1]) != sizes[1])
    fail("has damaged points: they do not unpack");
  return bytes;
}

void PcdFile::fail(const std::string& what) const {
  throw std::runtime_error("'" + name_ + "' " + what);
}

}  // namespace lamp
