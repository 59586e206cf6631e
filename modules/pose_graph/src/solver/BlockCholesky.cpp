#include "solver/BlockCholesky.h"

#include <cmath>

#include "solver/BlockKernels.h"

namespace lamp {

namespace {

/** Kernels may read behind the last block. */
constexpr size_t kSpare = 1;
/** Pivots below this share of their diagonal element are rounding errors. */
constexpr double kLeastPivot = 1e-14;

/** Replaces a symmetric block, of which the lower triangle counts, by the inverse of its Cholesky
 * factor. \param diagonal what pivots are compared with. \return false if one is too small. */
template <int kSize>
bool invertFactor(Eigen::Matrix<double, kSize, kSize>& block,
                  const Eigen::Matrix<double, kSize, 1>& diagonal) {
  Eigen::Matrix<double, kSize, kSize> factor = block;
  block.setZero();
  for (int j = 0; j < kSize; ++j) {
    if (!(factor(j, j) > kLeastPivot * diagonal[j])) return false;
    const double scale = 1.0 / std::sqrt(factor(j, j));
    for (int i = j; i < kSize; ++i) factor(i, j) *= scale;
    for (int k = j + 1; k < kSize; ++k)
      for (int i = k; i < kSize; ++i) factor(i, k) -= factor(i, j) * factor(k, j);
    block(j, j) = scale;
  }
  for (int j = 0; j < kSize; ++j)
    for (int i = j + 1; i < kSize; ++i) {
      double sum = 0;
      for (int k = j; k < i; ++k) sum += factor(i, k) * block(k, j);
      block(i, j) = -block(i, i) * sum;
    }
  return true;
}

}  // namespace

template <int kSize>
BlockCholesky<kSize>::BlockCholesky(const BlockMatrix<kSize>& structure)
    : BlockCholesky(structure, bestBlockKernels()) {}

template <int kSize>
BlockCholesky<kSize>::BlockCholesky(const BlockMatrix<kSize>& structure,
                                    const BlockKernels& kernels)
    : symbolic_(static_cast<int>(structure.diagonal.size()), structure.pairs),
      subtract_(kSize == 3 ? kernels.subtract3 : kernels.subtract6),
      blocks_(symbolic_.rows().size() + kSpare),
      diagonal_(structure.diagonal.size()),
      position_(structure.diagonal.size()) {
  static_assert(kSize == 3 || kSize == 6);
}

template <int kSize>
bool BlockCholesky<kSize>::factorize(const BlockMatrix<kSize>& matrix, double damping) {
  load(matrix, damping);
  for (int column = 0; column < symbolic_.size(); ++column) {
    subtractLeft(column);
    if (!finishColumn(column)) return false;
  }
  return true;
}

template <int kSize>
void BlockCholesky<kSize>::load(const BlockMatrix<kSize>& matrix, double damping) {
  for (Block& block : blocks_) block.setZero();
  for (int row = 0; row < symbolic_.size(); ++row) {
    Block& block = blocks_[symbolic_.columnBegin(symbolic_.place(row))];
    block = matrix.diagonal[row];
    block.diagonal() += damping * matrix.scale(row);
    diagonal_[symbolic_.place(row)] = block.diagonal();
  }
  for (size_t i = 0; i < matrix.pairs.size(); ++i) {
    const SymbolicCholesky::Target target = symbolic_.targets()[i];
    if (target.transposed)
      blocks_[target.entry] = matrix.off_diagonal[i].transpose();
    else
      blocks_[target.entry] = matrix.off_diagonal[i];
  }
}

template <int kSize>
void BlockCholesky<kSize>::subtractLeft(int column) {
  const int* const rows = symbolic_.rows().data();
  for (int entry = symbolic_.columnBegin(column); entry < symbolic_.columnEnd(column); ++entry)
    position_[rows[entry]] = entry;
  const auto* const end = symbolic_.leftEnd(column);
  for (const auto* left = symbolic_.leftBegin(column); left != end; ++left) {
    const double* const block = blocks_[left->entry].data();
    subtract_(block, block, rows + left->entry,
              static_cast<size_t>(symbolic_.columnEnd(left->column) - left->entry),
              position_.data(), blocks_.front().data());
  }
}

template <int kSize>
bool BlockCholesky<kSize>::finishColumn(int column) {
  const int begin = symbolic_.columnBegin(column);
  if (!invertFactor<kSize>(blocks_[begin], diagonal_[column])) return false;
  const Block inverse_transposed = blocks_[begin].transpose();
  for (int entry = begin + 1; entry < symbolic_.columnEnd(column); ++entry)
    blocks_[entry] = (blocks_[entry] * inverse_transposed).eval();
  return true;
}

template <int kSize>
void BlockCholesky<kSize>::solve(Eigen::VectorXd& x) const {
  using Part = Eigen::Matrix<double, kSize, 1>;
  std::vector<Part> y(symbolic_.size());
  for (int row = 0; row < symbolic_.size(); ++row)
    y[symbolic_.place(row)] = x.segment<kSize>(kSize * row);
  const int* const rows = symbolic_.rows().data();
  for (int column = 0; column < symbolic_.size(); ++column) {
    const int begin = symbolic_.columnBegin(column), end = symbolic_.columnEnd(column);
    const Part part = blocks_[begin] * y[column];
    for (int entry = begin + 1; entry < end; ++entry)
      y[rows[entry]].noalias() -= blocks_[entry] * part;
    y[column] = part;
  }
  for (int column = symbolic_.size() - 1; column >= 0; --column) {
    const int begin = symbolic_.columnBegin(column), end = symbolic_.columnEnd(column);
    Part part = y[column];
    for (int entry = begin + 1; entry < end; ++entry)
      part.noalias() -= blocks_[entry].transpose() * y[rows[entry]];
    y[column].noalias() = blocks_[begin].transpose() * part;
  }
  for (int row = 0; row < symbolic_.size(); ++row)
    x.segment<kSize>(kSize * row) = y[symbolic_.place(row)];
}

template <int kSize>
std::vector<typename BlockCholesky<kSize>::InverseBlock> BlockCholesky<kSize>::inverseColumn(
    int row) const {
  // A column of the factor reaches none but its ancestors in the elimination tree, of which the
  // first below the diagonal is the parent.
  const int* const rows = symbolic_.rows().data();
  std::vector<InverseBlock> column;
  std::vector<size_t> at(symbolic_.size());
  for (int place = symbolic_.place(row);;) {
    at[place] = column.size();
    column.push_back({place, Block::Zero()});
    const int parent = symbolic_.columnBegin(place) + 1;
    if (parent == symbolic_.columnEnd(place)) break;
    place = rows[parent];
  }
  column[0].block.setIdentity();
  for (InverseBlock& item : column) {
    const int begin = symbolic_.columnBegin(item.place), end = symbolic_.columnEnd(item.place);
    item.block = (blocks_[begin] * item.block).eval();
    for (int entry = begin + 1; entry < end; ++entry)
      column[at[rows[entry]]].block.noalias() -= blocks_[entry] * item.block;
  }
  return column;
}

// Erisman, Tinney, "On computing certain elements of the inverse of a sparse matrix", CACM 1975:
// from Lᵀ Z = L⁻¹, the columns of Z from the last to the first. The rows of a column of the factor
// are all neighbours in it, so what the sums need is there.
template <int kSize>
std::vector<typename BlockCholesky<kSize>::Block> BlockCholesky<kSize>::selectedInverse() const {
  const int* const rows = symbolic_.rows().data();
  std::vector<Block> inverse(symbolic_.rows().size(), Block::Zero()),
      scaled(symbolic_.rows().size());
  std::vector<int> position(symbolic_.size(), -1);  // by row: its entry in the column at work
  for (int column = symbolic_.size() - 1; column >= 0; --column) {
    const int begin = symbolic_.columnBegin(column), end = symbolic_.columnEnd(column);
    for (int entry = begin + 1; entry < end; ++entry) {
      position[rows[entry]] = entry;
      scaled[entry].noalias() = blocks_[entry] * blocks_[begin];
    }
    for (int entry = begin + 1; entry < end; ++entry) {
      const int right = rows[entry];
      const int diagonal = symbolic_.columnBegin(right);
      Block sum = inverse[diagonal] * scaled[entry];
      for (int below = diagonal + 1; below < symbolic_.columnEnd(right); ++below) {
        const int at = position[rows[below]];
        if (at < 0) continue;
        inverse[at].noalias() -= inverse[below] * scaled[entry];
        sum.noalias() += inverse[below].transpose() * scaled[at];
      }
      inverse[entry] -= sum;
    }
    Block diagonal = blocks_[begin].transpose() * blocks_[begin];
    for (int entry = begin + 1; entry < end; ++entry) {
      diagonal.noalias() -= scaled[entry].transpose() * inverse[entry];
      position[rows[entry]] = -1;
    }
    inverse[begin] = diagonal;
  }
  return inverse;
}

template class BlockCholesky<3>;
template class BlockCholesky<6>;

}  // namespace lamp
