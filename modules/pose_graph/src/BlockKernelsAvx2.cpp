#if defined(__x86_64__)

#include <immintrin.h>

#include "BlockKernel.h"
#include "BlockProducts.h"

namespace lamp {

namespace {

struct Avx2Column6 {
  static constexpr int kAtOnce = 6;

  void load(const double* from) {
    first = _mm256_loadu_pd(from);
    last = _mm_loadu_pd(from + 4);
  }
  void store(double* to) const {
    _mm256_storeu_pd(to, first);
    _mm_storeu_pd(to + 4, last);
  }
  void subtract(const Avx2Column6& column, double factor) {
    first = _mm256_fnmadd_pd(column.first, _mm256_set1_pd(factor), first);
    last = _mm_fnmadd_pd(column.last, _mm_set1_pd(factor), last);
  }

  __m256d first;
  __m128d last;
};

}  // namespace

extern const BlockKernels kAvx2Kernels;
const BlockKernels kAvx2Kernels = {"avx2", subtractProducts<6, Avx2Column6>};

}  // namespace lamp

#endif
