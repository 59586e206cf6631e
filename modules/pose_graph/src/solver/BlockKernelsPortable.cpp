#include "solver/BlockKernel.h"
#include "solver/BlockProducts.h"
#include "solver/BlockTiles.h"

namespace lamp {

namespace {

struct Column6 {
  static constexpr int kAtOnce = 3;

  void load(const double* from) { __builtin_memcpy(pairs, from, sizeof(pairs)); }
  void store(double* to) const { __builtin_memcpy(to, pairs, sizeof(pairs)); }
  void subtract(const Column6& column, double factor) {
    for (int i = 0; i < 3; ++i) pairs[i] -= column.pairs[i] * factor;
  }

  Pair pairs[3];
};

struct PairVector {
  static constexpr int kSize = 2;

  void setZero() { pair = Pair{}; }
  void load(const double* from) { __builtin_memcpy(&pair, from, sizeof(pair)); }
  void store(double* to) const { __builtin_memcpy(to, &pair, sizeof(pair)); }
  void add(const PairVector& vector, double factor) { pair += vector.pair * factor; }

  Pair pair;
};

}  // namespace

extern const BlockKernels kPortableKernels;
const BlockKernels kPortableKernels = {
    "portable", subtractProducts<3, Column3>, subtractProducts<6, Column6>,
    subtractTile<3, Column3, PairVector, 3, 3>, subtractTile<6, Column6, PairVector, 3, 3>};

}  // namespace lamp
