#include "LayoutCursor.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

#include "ObjectHeader.h"
#include "RewindableStream.h"

namespace lamp {
namespace {

/** Rows or columns of a matrix. */
constexpr uint64_t kMaxSide = uint64_t{1} << 20;

[[noreturn]] void damaged(const std::string& what) {
  throw std::runtime_error(what);
}

}  // namespace

uint64_t LayoutCursor::integer(size_t bytes) {
  const uint8_t* const start = stream_.require(bytes);
  uint64_t value = 0;
  for (size_t i = 0; i < bytes; ++i) value |= uint64_t{start[i]} << (8 * i);
  stream_.skip(bytes);
  return value;
}

bool LayoutCursor::flag() {
  const uint8_t value = byte();
  if (value > 1) damaged("a flag that is neither set nor unset");
  return value == 1;
}

void LayoutCursor::array(uint64_t count, size_t bytes_each) {
  if (count > RewindableStream::kMaxKeptBytes / bytes_each) damaged("a size beyond all bounds");
  stream_.require(static_cast<size_t>(count) * bytes_each);
  stream_.skip(static_cast<size_t>(count) * bytes_each);
}

void LayoutCursor::grid(uint64_t rows, uint64_t columns, size_t bytes_each) {
  if (rows > kMaxSide || columns > kMaxSide) damaged("a matrix beyond all bounds");
  array(rows * columns, bytes_each);
}

void LayoutCursor::coordinates() {
  const uint32_t points = number();
  array(points, sizeof(float));
  for (int axis = 1; axis < 3; ++axis) {
    if (number() != points) damaged("coordinates of different numbers of points");
    array(points, sizeof(float));
  }
}

void LayoutCursor::text() {
  constexpr uint32_t kMaxText = 4096;
  const uint32_t size = number();
  if (size > kMaxText) damaged("a text beyond all bounds");
  skip(size);
}

void LayoutCursor::text(std::string_view expected) {
  const uint32_t size = number();
  if (size != expected.size() || std::memcmp(stream_.require(size), expected.data(), size) != 0)
    damaged("another text than " + std::string(expected));
  skip(size);
}

void LayoutCursor::part(Classes classes) {
  const Header found = header();
  const std::string_view name = found.id ? found.id->className : "nullptr";
  if (std::find(classes.begin(), classes.end(), name) == classes.end())
    damaged("a part of the class " + std::string(name) + ", which does not belong there");
  body(found, partLayouts());
}

void LayoutCursor::optionalPart(Classes classes) {
  const uint64_t start = stream_.position();
  const Header found = header();
  if (!found.id) return body(found, partLayouts());
  stream_.moveTo(start);
  part(classes);
}

void LayoutCursor::picture() {
  const uint64_t start = stream_.position();
  part({classes::kPicture});
  pictures_.push_back({start, stream_.position()});
}

void LayoutCursor::entry(const mrpt::rtti::TRuntimeClassId* base) {
  const Header found = header();
  if (!found.id || !found.id->derivedFrom(base)) damaged("an entry of a class that cannot be one");
  body(found, recordedLayouts());
}

void LayoutCursor::recorded() {
  body(header(), recordedLayouts());
}

LayoutCursor::Header LayoutCursor::header() {
  const size_t ready = stream_.prepare(kMaxHeaderBytes);
  const auto name = parseObjectHeader(stream_.data(), ready);
  if (!name) damaged("no object header");
  Header header;
  header.end_flag = (stream_.data()[0] & 0x80) != 0;
  skip((header.end_flag ? 1 : 4) + name->size());
  if (*name == "nullptr") return header;
  header.id = mrpt::rtti::findRegisteredClass(*name);
  if (!header.id) damaged("an object of the unknown class " + *name);
  header.version = static_cast<int>(header.end_flag ? byte() : number());
  return header;
}

void LayoutCursor::body(const Header& header, const ClassLayouts& layouts) {
  if (header.id) {
    const auto layout = layouts.find(header.id->className);
    if (layout == layouts.end()) throw UnreadClass(header.id->className);
    if (header.version < layout->second.oldest || header.version > layout->second.newest)
      damaged("a version that is not known");
    layout->second.follow(*this, header.version);
  }
  if (header.end_flag && byte() != kObjectEndFlag) damaged("no end of the object");
}

}  // namespace lamp
