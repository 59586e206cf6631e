#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace lamp {

class RewindableStream;

/** Offsets of the uncompressed data. */
struct ByteRange {
  uint64_t begin = 0, end = 0;
};

struct ObjectLayout {
  uint64_t end = 0;                 ///< offset just behind the object
  std::vector<ByteRange> pictures;  ///< the objects of class CImage in it
};

/** The object, or one in it, is of a known class that we have no use for and so no layout of. */
class UnreadClass : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/** Follows the object at the stream's position to its end. MRPT's deserialisers trust sizes, class
 * names and versions, and so must not see an object for which this fails: they would allocate
 * gigabytes, or crash.
 *  \throws UnreadClass; std::runtime_error if the object is damaged. */
ObjectLayout layoutOf(RewindableStream& stream);

}  // namespace lamp
