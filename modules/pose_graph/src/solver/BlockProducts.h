#pragma once

#include <cstddef>

// Included by the kernels of each instruction set, which are compiled with flags of their own: it
// must not include a header whose inline functions other files share.

namespace lamp {

namespace {

/** Pairs of numbers, which every 64-bit processor can multiply at once. */
using Pair = double __attribute__((vector_size(16)));

struct Column3 {
  static constexpr int kAtOnce = 3;

  void load(const double* from) {
    __builtin_memcpy(&pair, from, sizeof(pair));
    last = from[2];
  }
  void store(double* to) const {
    __builtin_memcpy(to, &pair, sizeof(pair));
    to[2] = last;
  }
  void subtract(const Column3& column, double factor) {
    pair -= column.pair * factor;
    last -= column.last * factor;
  }

  Pair pair;
  double last;
};

}  // namespace

/** The loop of BlockKernels. `Column` holds one column of a block in registers, where the sums of
 * `Column::kAtOnce` columns fit. */
template <int kSize, class Column>
void subtractProducts(const double* left, const double* right, const int* rows, size_t count,
                      const int* position, double* target) {
  constexpr int kAtOnce = Column::kAtOnce;
  static_assert(kSize % kAtOnce == 0);
  for (size_t i = 0; i < count; ++i, left += kSize * kSize) {
    double* const block = target + static_cast<size_t>(position[rows[i]]) * kSize * kSize;
    for (int first = 0; first < kSize; first += kAtOnce) {
      Column sums[kAtOnce];
      for (int c = 0; c < kAtOnce; ++c) sums[c].load(block + (first + c) * kSize);
      for (int k = 0; k < kSize; ++k) {
        Column column;
        column.load(left + k * kSize);
        for (int c = 0; c < kAtOnce; ++c) sums[c].subtract(column, right[first + c + k * kSize]);
      }
      for (int c = 0; c < kAtOnce; ++c) sums[c].store(block + (first + c) * kSize);
    }
  }
}

}  // namespace lamp
