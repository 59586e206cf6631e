#pragma once

#include <cstddef>
#include <cstring>

namespace lamp {

/** How a file of points stores one number, little-endian. */
struct Scalar {
  size_t size = 0;                         ///< bytes
  double (*value)(const char*) = nullptr;  ///< from the bytes

  template <class T>
  static constexpr Scalar of() {
    return {sizeof(T), [](const char* bytes) {
              T value;
              std::memcpy(&value, bytes, sizeof value);
              return static_cast<double>(value);
            }};
  }
};

}  // namespace lamp
