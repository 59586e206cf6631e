#pragma once

#include <vector>

#include "solver/BlockKernel.h"
#include "solver/BlockMatrix.h"
#include "solver/SymbolicCholesky.h"
#include "solver/TileProducts.h"

namespace lamp {

/** Sparse Cholesky factorisation L·Lᵀ of symmetric positive definite block matrices of one
 * structure: left-looking, by panels of columns with the same rows (Ng, Peyton, "Block sparse
 * Cholesky algorithms on advanced uniprocessor computers", SIAM J. Sci. Comput. 1993). One thread;
 * the order of all sums is fixed. */
template <int kSize>
class BlockCholesky {
 public:
  using Block = typename BlockMatrix<kSize>::Block;

  /** Takes the structure; matrices to be factorised must have the same pairs. */
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

  const SymbolicCholesky& symbolic() const { return symbolic_; }
  /** Blocks of the factor as symbolic() places them; those on the diagonal hold the inverse of the
   * factor's lower triangle. */
  const std::vector<Block>& blocks() const { return blocks_; }
  const BlockKernels& kernels() const { return kernels_; }

 private:
  void load(const BlockMatrix<kSize>& matrix, double damping);
  void subtractLeft(int panel);
  void subtract(int left, int columns, int begin, int end);
  void subtractColumn(int left, int column, int begin, int end);
  void subtractTiles(int left, int columns, int begin, int end);
  bool finishPanel(int panel);
  bool finishColumn(int column);
  void wait(int panel, int next_row);

  SymbolicCholesky symbolic_;
  const BlockKernels& kernels_;
  SubtractProducts subtract_;
  TileProducts<kSize> tiles_;
  std::vector<Block> blocks_;
  std::vector<Eigen::Matrix<double, kSize, 1>> diagonal_;  ///< of the damped matrix, by place
  std::vector<int> position_;  ///< by row: its index in the current panel
  /** For each panel, a linked list of the finished panels that change it next: by panel, the first
   * of its list; by finished panel, its successor there, and which of its rows comes next. */
  std::vector<int> first_waiting_, next_waiting_, next_row_;
};

extern template class BlockCholesky<3>;
extern template class BlockCholesky<6>;

}  // namespace lamp
