#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lamp {

/** How many bytes must at least follow, if a 32-bit number that is about to be read is the size of
 * a point cloud, a matrix, or a laser scan; else 0.
 *
 * MRPT allocates these before it knows whether as many data follow, and does not check that the
 * allocation worked.
 *  \param object its bytes up to here; \param ahead the next bytes, at least four. */
uint64_t announcedSize(std::string_view object, std::string_view ahead);

}  // namespace lamp
