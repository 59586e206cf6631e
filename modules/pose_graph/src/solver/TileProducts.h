#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "solver/BlockKernels.h"
#include "solver/BlockMatrix.h"

namespace lamp {

/** Products of block matrices of any size by BlockKernels' tiles: blocks are copied into the order
 * in which a tile reads them (Goto, van de Geijn, "Anatomy of high-performance matrix
 * multiplication", ACM TOMS 2008). */
template <int kSize>
class TileProducts {
 public:
  using Block = typename BlockMatrix<kSize>::Block;

  /** The most columns of a product: with so many blocks the copies stay in the cache. */
  static constexpr int kMaxColumns = 192 / kSize;

  explicit TileProducts(const BlockKernels& kernels)
      : subtract_(kSize == 3 ? kernels.tile3 : kernels.tile6),
        left_(kTileRows * kMaxDepth * kSize),
        right_((kMaxColumns + kColumns) * kMaxDepth * kSize * kSize) {}

  /** A block of a factor, or its transpose. */
  struct Operand {
    const Block& block;
    bool transposed;
  };

  /** target(i, j) -= Σ left(i, k) right(j, k)ᵀ, for i < rows, j < columns, k < depth.
   * \param left, right give an Operand. \param target gives a block, or null for one that is not
   * wanted. \param columns at most kMaxColumns. */
  template <class Left, class Right, class Target>
  void subtract(int rows, int columns, int depth, const Left& left, const Right& right,
                const Target& target) {
    if (rows * columns * depth < kFew)
      return subtractEach(rows, columns, depth, left, right, target);
    for (int begin = 0; begin < depth; begin += kMaxDepth) {
      const int end = std::min(depth, begin + kMaxDepth);
      for (int j = 0; j < columns; ++j)
        for (int k = begin; k < end; ++k)
          copy<kTileColumns>(right(j, k),
                             right_.data() +
                                 (j / kColumns * (end - begin) + k - begin) * kTileColumns * kSize +
                                 j % kColumns * kSize);
      for (int i = 0; i < rows; i += kRows) {
        for (int k = begin; k < end; ++k)
          for (int row = i; row < std::min(rows, i + kRows); ++row)
            copy<kTileRows>(left(row, k),
                            left_.data() + (k - begin) * kTileRows * kSize + (row - i) * kSize);
        subtractRow(i, std::min(rows, i + kRows), columns, end - begin, target);
      }
    }
  }

 private:
  /** From this many products of blocks on, copying pays. */
  static constexpr int kFew = 12;
  /** Blocks in a column and a row of a tile. */
  static constexpr int kRows = kTileRows / kSize, kColumns = kTileColumns / kSize;
  static constexpr int kMaxDepth = kMaxColumns;

  template <class Left, class Right, class Target>
  static void subtractEach(int rows, int columns, int depth, const Left& left, const Right& right,
                           const Target& target) {
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i) {
        Block* const block = target(i, j);
        for (int k = 0; block && k < depth; ++k) subtract(left(i, k), right(j, k), *block);
      }
  }

  static void subtract(const Operand& left, const Operand& right, Block& target) {
    if (left.transposed && right.transposed)
      target.noalias() -= left.block.transpose() * right.block;
    else if (left.transposed)
      target.noalias() -= left.block.transpose() * right.block.transpose();
    else if (right.transposed)
      target.noalias() -= left.block * right.block;
    else
      target.noalias() -= left.block * right.block.transpose();
  }

  template <int kHeight>
  static void copy(const Operand& operand, double* to) {
    for (int c = 0; c < kSize; ++c, to += kHeight) {
      Eigen::Map<Eigen::Matrix<double, kSize, 1>> column(to);
      if (operand.transposed)
        column = operand.block.row(c);
      else
        column = operand.block.col(c);
    }
  }

  template <class Target>
  void subtractRow(int begin, int end, int columns, int depth, const Target& target) {
    for (int j = 0; j < columns; j += kColumns) {
      double* blocks[kRows * kColumns];
      bool wanted = false;
      for (int at = 0; at < kRows * kColumns; ++at) {
        const int row = begin + at % kRows, column = j + at / kRows;
        Block* const block = row < end && column < columns ? target(row, column) : nullptr;
        blocks[at] = block ? block->data() : unwanted_.data();
        wanted |= block != nullptr;
      }
      if (wanted)
        subtract_(left_.data(), right_.data() + j / kColumns * depth * kTileColumns * kSize,
                  static_cast<size_t>(depth) * kSize, blocks);
    }
  }

  SubtractTile subtract_;
  std::vector<double> left_, right_;
  Block unwanted_ = Block::Zero();
};

}  // namespace lamp
