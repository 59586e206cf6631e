#pragma once

#include <cstdint>

namespace lamp {

/** A number that looks like chance but is always the same (the finalizer of MurmurHash3): picks
 * evenly among things that have an order. */
inline uint64_t shuffledBits(uint64_t x) {
  x ^= x >> 33;
  x *= 0xff51afd7ed558ccdULL;
  x ^= x >> 33;
  x *= 0xc4ceb9fe1a85ec53ULL;
  return x ^ (x >> 33);
}

}  // namespace lamp
