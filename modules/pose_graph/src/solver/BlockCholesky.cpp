#include "solver/BlockCholesky.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/BlockKernels.h"

namespace lamp {

namespace {

/** Kernels may read beyond the last block. */
constexpr size_t kSpare = 1;
/** Pivots below this share of their diagonal element are rounding errors. */
constexpr double kLeastPivot = 1e-14;
/** Copying a part of a panel for tiles pays if it is this many numbers wide, and as many high. */
constexpr int kThick = 24;

/** Replaces a symmetric block, given by its lower triangle, by the inverse of its Cholesky factor.
 * \param diagonal what pivots are compared with. \return false if a pivot is too small. */
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
    : symbolic_(static_cast<int>(structure.diagonal.size()), structure.pairs,
                TileProducts<kSize>::kMaxColumns),
      kernels_(kernels),
      subtract_(kSize == 3 ? kernels.subtract3 : kernels.subtract6),
      tiles_(kernels),
      blocks_(symbolic_.rows().size() + kSpare),
      diagonal_(structure.diagonal.size()),
      position_(structure.diagonal.size()),
      next_waiting_(symbolic_.panels()),
      next_row_(symbolic_.panels()) {
  static_assert(kSize == 3 || kSize == 6);
}

template <int kSize>
bool BlockCholesky<kSize>::factorize(const BlockMatrix<kSize>& matrix, double damping) {
  load(matrix, damping);
  first_waiting_.assign(symbolic_.panels(), -1);
  for (int panel = 0; panel < symbolic_.panels(); ++panel) {
    const int* const rows = symbolic_.panelRows(panel);
    for (int i = 0; i < symbolic_.panelHeight(panel); ++i) position_[rows[i]] = i;
    subtractLeft(panel);
    if (!finishPanel(panel)) return false;
    wait(panel, symbolic_.panelWidth(panel));
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
void BlockCholesky<kSize>::wait(int panel, int next_row) {
  if (next_row == symbolic_.panelHeight(panel)) return;
  int& first = first_waiting_[symbolic_.panelOf(symbolic_.panelRows(panel)[next_row])];
  next_row_[panel] = next_row;
  next_waiting_[panel] = std::exchange(first, panel);
}

/** Subtracts from a panel what the columns on its left contribute. */
template <int kSize>
void BlockCholesky<kSize>::subtractLeft(int panel) {
  const int panel_end = symbolic_.panelBegin(panel) + symbolic_.panelWidth(panel);
  for (int left = first_waiting_[panel]; left >= 0;) {
    const int next_left = next_waiting_[left], begin = next_row_[left];
    const int* const rows = symbolic_.panelRows(left);
    int end = begin + 1;
    while (end < symbolic_.panelHeight(left) && rows[end] < panel_end) ++end;
    subtract(left, symbolic_.panelWidth(left), begin, end);
    wait(left, end);
    left = next_left;
  }
}

/** Subtracts what the first `columns` of panel `left` contribute to the columns that its rows
 * `begin` to `end` stand for. */
template <int kSize>
void BlockCholesky<kSize>::subtract(int left, int columns, int begin, int end) {
  if (kSize * columns >= kThick && kSize * (symbolic_.panelHeight(left) - begin) >= kThick)
    return subtractTiles(left, columns, begin, end);
  for (int column = 0; column < columns; ++column) subtractColumn(left, column, begin, end);
}

template <int kSize>
void BlockCholesky<kSize>::subtractColumn(int left, int column, int begin, int end) {
  const int* const rows = symbolic_.panelRows(left);
  const int entry = symbolic_.panelEntry(symbolic_.panelBegin(left) + column);
  for (int i = begin; i < end; ++i) {
    const double* const block = blocks_[entry + i].data();
    subtract_(block, block, rows + i, static_cast<size_t>(symbolic_.panelHeight(left) - i),
              position_.data(), blocks_[symbolic_.panelEntry(rows[i])].data());
  }
}

template <int kSize>
void BlockCholesky<kSize>::subtractTiles(int left, int columns, int begin, int end) {
  const int* const rows = symbolic_.panelRows(left) + begin;
  const int first = symbolic_.panelBegin(left);
  const auto factor = [&](int row, int column) {
    return typename TileProducts<kSize>::Operand{
        blocks_[symbolic_.panelEntry(first + column) + begin + row], false};
  };
  const auto target = [&](int row, int column) {
    return row < column ? nullptr
                        : &blocks_[symbolic_.panelEntry(rows[column]) + position_[rows[row]]];
  };
  tiles_.subtract(symbolic_.panelHeight(left) - begin, end - begin, columns, factor, factor,
                  target);
}

template <int kSize>
bool BlockCholesky<kSize>::finishPanel(int panel) {
  constexpr int kAtOnce = kTileRows / kSize;
  for (int done = 0; done < symbolic_.panelWidth(panel); done += kAtOnce) {
    const int end = std::min(done + kAtOnce, symbolic_.panelWidth(panel));
    subtract(panel, done, done, end);
    for (int column = done; column < end; ++column) {
      if (!finishColumn(symbolic_.panelBegin(panel) + column)) return false;
      subtractColumn(panel, column, column + 1, end);
    }
  }
  return true;
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
  // A column has entries only at its ancestors in the elimination tree. The parent is the first
  // entry below the diagonal.
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

template class BlockCholesky<3>;
template class BlockCholesky<6>;

}  // namespace lamp
