#include "solver/BlockKernel.h"
#include "solver/BlockProducts.h"

namespace lamp {

namespace {

/** Pairs of numbers, which each processor of 64 bits can multiply at once. */
using Pair = double __attribute__((vector_size(16)));

struct Column6 {
  static constexpr int kAtOnce = 3;

  void load(const double* from) { __builtin_memcpy(pairs, from, sizeof(pairs)); }
  void store(double* to) const { __builtin_memcpy(to, pairs, sizeof(pairs)); }
  void subtract(const Column6& column, double factor) {
    for (int i = 0; i < 3; ++i) pairs[i] -= column.pairs[i] * factor;
  }

  Pair pairs[3];
};

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

extern const BlockKernels kPortableKernels;
const BlockKernels kPortableKernels = {"portable", subtractProducts<3, Column3>,
                                       subtractProducts<6, Column6>};

}  // namespace lamp
