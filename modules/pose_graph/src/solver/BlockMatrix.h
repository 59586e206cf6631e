#pragma once

#include <Eigen/Core>
#include <vector>

namespace lamp {

/** Row and column of an off-diagonal block of a symmetric matrix. */
struct BlockPair {
  int row, column;

  friend bool operator==(BlockPair a, BlockPair b) {
    return a.row == b.row && a.column == b.column;
  }
};

/** A sparse symmetric matrix of square blocks; of each off-diagonal block and its transpose only
 * one is stored. */
template <int kSize>
struct BlockMatrix {
  using Block = Eigen::Matrix<double, kSize, kSize>;

  std::vector<Block> diagonal;
  std::vector<BlockPair> pairs;  ///< each pair of rows at most once
  std::vector<Block> off_diagonal;

  /** The scale of Marquardt's damping: the diagonal elements, kept above zero. */
  auto scale(size_t row) const { return diagonal[row].diagonal().cwiseMax(1e-6); }
  /** xᵀ D x, where D has the scales on its diagonal. */
  double scaledNorm2(const Eigen::VectorXd& x) const {
    double sum = 0;
    for (size_t row = 0; row < diagonal.size(); ++row)
      sum += x.segment<kSize>(kSize * static_cast<Eigen::Index>(row)).cwiseAbs2().dot(scale(row));
    return sum;
  }

  void setZero() {
    for (Block& block : diagonal) block.setZero();
    for (Block& block : off_diagonal) block.setZero();
  }
};

}  // namespace lamp
