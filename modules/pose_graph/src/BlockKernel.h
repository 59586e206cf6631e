#pragma once

#include <cstddef>

namespace lamp {

/** The inner loop of the block Cholesky factorisation:
 *
 * for each i below `count`: target[position[rows[i]]] -= left[i] * rightᵀ
 *
 * Blocks are square, column-major and stored one after another. */
using SubtractProducts = void (*)(const double* left, const double* right, const int* rows,
                                  size_t count, const int* position, double* target);

/** The kernels for one instruction set. */
struct BlockKernels {
  const char* instruction_set;
  SubtractProducts subtract6;  ///< blocks of 6 x 6
};

/** Blocks of 3 x 3. Too small to gain from wide registers: the same for all instruction sets. */
void subtract3(const double* left, const double* right, const int* rows, size_t count,
               const int* position, double* target);

}  // namespace lamp
