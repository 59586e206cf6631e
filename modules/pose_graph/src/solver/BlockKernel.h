#pragma once

#include <cstddef>

namespace lamp {

/** Products of blocks, for columns that are too few or too short to be worth packing:
 *
 * for each i below `count`: target[position[rows[i]]] -= left[i] * rightᵀ
 *
 * Blocks are square, column-major and stored one after another. With blocks of 3 x 3, the number
 * after the last block may be read. */
using SubtractProducts = void (*)(const double* left, const double* right, const int* rows,
                                  size_t count, const int* position, double* target);

/** Numbers in a row and a column of a tile. */
constexpr int kTileRows = 24, kTileColumns = 6;

/** A tile of a product of matrices: C -= A Bᵀ.
 * \param left A, kTileRows x depth, column-major. \param right B, kTileColumns x depth, likewise.
 * \param blocks C's square blocks, each column-major, in column-major order. */
using SubtractTile = void (*)(const double* left, const double* right, size_t depth,
                              double* const* blocks);

/** The kernels for one instruction set. */
struct BlockKernels {
  const char* instruction_set;
  SubtractProducts subtract3;  ///< blocks of 3 x 3
  SubtractProducts subtract6;  ///< blocks of 6 x 6
  SubtractTile tile3, tile6;
};

#if defined(__x86_64__)
/** Serves AVX-512, too: the blocks are too small for wider registers. */
void subtract3Avx2(const double* left, const double* right, const int* rows, size_t count,
                   const int* position, double* target);
#endif

}  // namespace lamp
