#pragma once

#include <mrpt/rtti/CObject.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <vector>

#include "ClassLayouts.h"
#include "ObjectLayout.h"

namespace lamp {

class RewindableStream;

/** Goes over the bytes of an object as MRPT reads them, and makes sure that all of them are there.
 * Every function throws std::runtime_error where they are not, or where the class or the version is
 * none that MRPT expects there. */
class LayoutCursor {
 public:
  explicit LayoutCursor(RewindableStream& stream) : stream_(stream) {}

  /** Integers, little endian. */
  uint8_t byte() { return static_cast<uint8_t>(integer(1)); }
  uint16_t shortNumber() { return static_cast<uint16_t>(integer(2)); }
  uint32_t number() { return static_cast<uint32_t>(integer(4)); }
  uint64_t longNumber() { return integer(8); }
  /** MRPT reads the byte into a bool, which must not be anything but 0 or 1. */
  bool flag();
  /** A bool that old releases left without a value, and that nobody here looks at. */
  bool unusedFlag() { return byte() != 0; }

  void skip(uint64_t bytes) { array(bytes, 1); }
  void array(uint64_t count, size_t bytes_each);
  /** The elements of a matrix. */
  void grid(uint64_t rows, uint64_t columns, size_t bytes_each);
  /** A std::vector of numbers: its size, and the elements. */
  void list(size_t bytes_each) { array(number(), bytes_each); }
  /** Three such vectors of the same size: coordinates of points. */
  void coordinates();
  /** A label, or the name of a file or a type: a string of no more than 4096 bytes. */
  void text();
  void text(std::string_view expected);

  using Classes = std::initializer_list<std::string_view>;
  /** A part of one of the classes. */
  void part(Classes classes);
  /** A part of one of the classes, or the mark that there is none. */
  void optionalPart(Classes classes);
  /** A part of class CImage. */
  void picture();
  /** An object of any class below `base` that has a layout. \throws UnreadClass. */
  void entry(const mrpt::rtti::TRuntimeClassId* base);
  /** An object of any class that stands in rawlogs. \throws UnreadClass. */
  void recorded();

  const std::vector<ByteRange>& pictures() const { return pictures_; }

 private:
  struct Header {
    const mrpt::rtti::TRuntimeClassId* id = nullptr;  ///< null: there is no object
    int version = 0;
    bool end_flag = true;  ///< none before MRPT 0.5.5
  };
  uint64_t integer(size_t bytes);
  Header header();
  void body(const Header& header, const ClassLayouts& layouts);

  RewindableStream& stream_;
  std::vector<ByteRange> pictures_;
};

}  // namespace lamp
