#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace lamp {

/** No object header is longer than this. */
constexpr size_t kMaxHeaderBytes = 4 + 120 + 4;

/** Class name in an MRPT object header: one byte `0x80 | length`, then the name; before MRPT 0.5.5
 * a 32-bit length. \return none if the bytes are no header. */
std::optional<std::string> parseObjectHeader(const uint8_t* bytes, size_t count);

/** Class name of a header that we would go on at after damage: the current format, and a class that
 * can stand in a rawlog, or one that nobody here knows but whose name looks like one.
 *  \param after_object an object seems to end just before; an unknown class needs that. */
std::optional<std::string> parseResumableHeader(const uint8_t* bytes, size_t count,
                                                bool after_object);

/** Last byte of every MRPT object. */
constexpr uint8_t kObjectEndFlag = 0x88;

}  // namespace lamp
