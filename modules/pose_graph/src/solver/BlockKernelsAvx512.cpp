#if defined(__x86_64__)

#include <immintrin.h>

#include "solver/BlockKernel.h"
#include "solver/BlockProducts.h"
#include "solver/BlockTiles.h"

namespace lamp {

namespace {

struct Avx512Column6 {
  static constexpr int kAtOnce = 6;
  static constexpr __mmask8 kMask = 0b111111;

  void load(const double* from) { values = _mm512_maskz_loadu_pd(kMask, from); }
  void store(double* to) const { _mm512_mask_storeu_pd(to, kMask, values); }
  void subtract(const Avx512Column6& column, double factor) {
    values = _mm512_fnmadd_pd(column.values, _mm512_set1_pd(factor), values);
  }

  __m512d values;
};

struct Avx512Vector {
  static constexpr int kSize = 8;

  void setZero() { values = _mm512_setzero_pd(); }
  void load(const double* from) { values = _mm512_loadu_pd(from); }
  void store(double* to) const { _mm512_storeu_pd(to, values); }
  void add(const Avx512Vector& vector, double factor) {
    values = _mm512_fmadd_pd(vector.values, _mm512_set1_pd(factor), values);
  }

  __m512d values;
};

}  // namespace

extern const BlockKernels kAvx512Kernels;
const BlockKernels kAvx512Kernels = {"avx512", subtract3Avx2, subtractProducts<6, Avx512Column6>,
                                     subtractTile<3, Column3, Avx512Vector, 3, 6>,
                                     subtractTile<6, Avx512Column6, Avx512Vector, 3, 6>};

}  // namespace lamp

#endif
