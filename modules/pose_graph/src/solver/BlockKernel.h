#pragma once

#include <cstddef>

namespace lamp {

/** The inner loop of the block Cholesky factorisation:
 *
 * for each i below `count`: target[position[rows[i]]] -= left[i] * rightᵀ
 *
 * Blocks are square, column-major and stored one after another. Of those of 3 x 3, the number
 * behind the last may be read. */
using SubtractProducts = void (*)(const double* left, const double* right, const int* rows,
                                  size_t count, const int* position, double* target);

/** The kernels for one instruction set. */
struct BlockKernels {
  const char* instruction_set;
  SubtractProducts subtract3;  ///< blocks of 3 x 3
  SubtractProducts subtract6;  ///< blocks of 6 x 6
};

#if defined(__x86_64__)
/** Too small for wider registers: that of AVX-512, too. */
void subtract3Avx2(const double* left, const double* right, const int* rows, size_t count,
                   const int* position, double* target);
#endif

}  // namespace lamp
