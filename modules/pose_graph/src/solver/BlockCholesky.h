#pragma once

#include <memory>
#include <vector>

#include "solver/BlockKernel.h"
#include "solver/BlockMatrix.h"
#include "solver/SymbolicCholesky.h"

namespace lamp {

/** Sparse Cholesky factorisation L·Lᵀ of symmetric positive definite block matrices of one
 * structure. One thread; the order of all sums is fixed. */
template <int kSize>
class BlockCholesky {
 public:
  using Block = typename BlockMatrix<kSize>::Block;

  /** Takes the structure; the matrix of a later factorize() must have the same pairs. */
  explicit BlockCholesky(const BlockMatrix<kSize>& structure);
  BlockCholesky(const BlockMatrix<kSize>& structure, const BlockKernels& kernels);

  /** \param damping added to the diagonal: damping · matrix.scale().
   * \return false if the damped matrix is not positive definite beyond rounding. */
  bool factorize(const BlockMatrix<kSize>& matrix, double damping);

  /** Solves for one vector, in place; the last factorize() must have succeeded. */
  void solve(Eigen::VectorXd& x) const;

  /** A block of L⁻¹. */
  struct InverseBlock {
    int place;  ///< of its row
    Block block;
  };
  /** A column of L⁻¹, from its diagonal downwards, the places ascending. The inverse's blocks are
   * the products of two such columns, (L⁻¹)ᵀ L⁻¹. */
  std::vector<InverseBlock> inverseColumn(int row) const;

  /** The inverse's blocks where the factor has blocks, in their order: for each pair of the
   * structure, and more. */
  std::vector<Block> selectedInverse() const;

  const SymbolicCholesky& symbolic() const { return symbolic_; }
  /** Blocks of the factor as symbolic() places them; those on the diagonal hold the inverse of the
   * factor's lower triangle. */
  const std::vector<Block>& blocks() const { return blocks_; }

 private:
  void load(const BlockMatrix<kSize>& matrix, double damping);
  void subtractLeft(int column);
  bool finishColumn(int column);

  SymbolicCholesky symbolic_;
  SubtractProducts subtract_;
  std::vector<Block> blocks_;
  std::vector<Eigen::Matrix<double, kSize, 1>> diagonal_;  ///< of the damped matrix, by place
  std::vector<int> position_;  ///< by row: its entry in the column at work
};

extern template class BlockCholesky<3>;
extern template class BlockCholesky<6>;

}  // namespace lamp
