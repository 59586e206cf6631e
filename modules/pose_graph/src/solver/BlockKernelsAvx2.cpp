#if defined(__x86_64__)

#include <immintrin.h>

#include "solver/BlockKernel.h"
#include "solver/BlockProducts.h"
#include "solver/BlockTiles.h"

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

struct Avx2Vector {
  static constexpr int kSize = 4;

  void setZero() { values = _mm256_setzero_pd(); }
  void load(const double* from) { values = _mm256_loadu_pd(from); }
  void store(double* to) const { _mm256_storeu_pd(to, values); }
  void add(const Avx2Vector& vector, double factor) {
    values = _mm256_fmadd_pd(vector.values, _mm256_set1_pd(factor), values);
  }

  __m256d values;
};

}  // namespace

/** Columns of three numbers in registers of four, whose last is the next column's first: each store
 * repairs what the one before it has spoilt. */
void subtract3Avx2(const double* left, const double* right, const int* rows, size_t count,
                   const int* position, double* target) {
  constexpr int kSize = 3;
  __m256d factor[kSize][kSize];  // by column of the product, then of the left block
  for (int c = 0; c < kSize; ++c)
    for (int k = 0; k < kSize; ++k) factor[c][k] = _mm256_set1_pd(right[c + k * kSize]);
  for (size_t i = 0; i < count; ++i, left += kSize * kSize) {
    double* const block = target + static_cast<size_t>(position[rows[i]]) * kSize * kSize;
    __m256d column[kSize], sum[kSize];
    for (int k = 0; k < kSize; ++k) column[k] = _mm256_loadu_pd(left + k * kSize);
    for (int c = 0; c < kSize; ++c) sum[c] = _mm256_loadu_pd(block + c * kSize);
    for (int c = 0; c < kSize; ++c)
      for (int k = 0; k < kSize; ++k) sum[c] = _mm256_fnmadd_pd(column[k], factor[c][k], sum[c]);
    _mm256_storeu_pd(block, sum[0]);
    _mm256_storeu_pd(block + kSize, sum[1]);
    _mm_storeu_pd(block + 2 * kSize, _mm256_castpd256_pd128(sum[2]));
    _mm_store_sd(block + 2 * kSize + 2, _mm256_extractf128_pd(sum[2], 1));
  }
}

extern const BlockKernels kAvx2Kernels;
const BlockKernels kAvx2Kernels = {"avx2", subtract3Avx2, subtractProducts<6, Avx2Column6>,
                                   subtractTile<3, Column3, Avx2Vector, 3, 3>,
                                   subtractTile<6, Avx2Column6, Avx2Vector, 3, 3>};

}  // namespace lamp

#endif
