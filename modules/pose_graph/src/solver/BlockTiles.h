#pragma once

#include "solver/BlockKernel.h"

// Included by the kernels of each instruction set, which are compiled with flags of their own: it
// must not include a header whose inline functions other files share.

namespace lamp {

/** A part of a tile whose sums fit into registers: kVectors of `Vector` by kColumns. */
template <class Vector, int kVectors, int kColumns>
void multiplyPart(const double* left, const double* right, size_t depth, double* tile) {
  Vector sums[kColumns][kVectors];
  for (auto& column : sums)
    for (Vector& sum : column) sum.setZero();
  for (size_t k = 0; k < depth; ++k, left += kTileRows, right += kTileColumns) {
    Vector rows[kVectors];
    for (int i = 0; i < kVectors; ++i) rows[i].load(left + i * Vector::kSize);
    for (int c = 0; c < kColumns; ++c)
      for (int i = 0; i < kVectors; ++i) sums[c][i].add(rows[i], right[c]);
  }
  for (int c = 0; c < kColumns; ++c)
    for (int i = 0; i < kVectors; ++i) sums[c][i].store(tile + c * kTileRows + i * Vector::kSize);
}

/** SubtractTile. `Column` holds one column of a block in registers. */
template <int kBlock, class Column, class Vector, int kVectors, int kColumns>
void subtractTile(const double* left, const double* right, size_t depth, double* const* blocks) {
  constexpr int kRows = kVectors * Vector::kSize;
  static_assert(kTileRows % kRows == 0 && kTileColumns % kColumns == 0);
  static_assert(kTileRows % kBlock == 0 && kTileColumns % kBlock == 0);
  double tile[kTileRows * kTileColumns];
  for (int column = 0; column < kTileColumns; column += kColumns)
    for (int row = 0; row < kTileRows; row += kRows)
      multiplyPart<Vector, kVectors, kColumns>(left + row, right + column, depth,
                                               tile + column * kTileRows + row);
  for (int column = 0; column < kTileColumns; column += kBlock)
    for (int row = 0; row < kTileRows; row += kBlock) {
      double* const block = *blocks++;
      const double* const part = tile + column * kTileRows + row;
      for (int c = 0; c < kBlock; ++c) {
        Column sum, product;
        sum.load(block + c * kBlock);
        product.load(part + c * kTileRows);
        sum.subtract(product, 1.0);
        sum.store(block + c * kBlock);
      }
    }
}

}  // namespace lamp
