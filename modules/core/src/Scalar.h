#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace lamp {

/** How a file of points stores one number. */
struct Scalar {
  size_t size = 0;                         ///< bytes
  double (*value)(const char*) = nullptr;  ///< from the bytes, little-endian

  template <class T>
  static constexpr Scalar of() {
    return {sizeof(T), [](const char* bytes) {
              T number;
              std::memcpy(&number, bytes, sizeof number);
              return static_cast<double>(number);
            }};
  }

  double bigEndian(const char* bytes) const {
    std::array<char, sizeof(double)> reversed{};
    std::reverse_copy(bytes, bytes + size, reversed.begin());
    return value(reversed.data());
  }
};

}  // namespace lamp
