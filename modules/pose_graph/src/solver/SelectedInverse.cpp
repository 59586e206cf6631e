#include "solver/SelectedInverse.h"

#include <algorithm>
#include <array>

#include "solver/TileProducts.h"

namespace lamp {

namespace {

/** From L Lᵀ Z = I, panel by panel from the last to the first. With J a panel's columns, R the rows
 * below them, and Y = L_RJ L_JJ⁻¹,
 *
 *   Z_RJ = -Z_RR Y   and   Z_JJ = L_JJ⁻ᵀ L_JJ⁻¹ - Yᵀ Z_RJ.
 *
 * The rows of a panel are all neighbours in the factor, so Z_RR is known already. */
template <int kSize>
class Inversion {
 public:
  using Block = typename BlockMatrix<kSize>::Block;

  explicit Inversion(const BlockCholesky<kSize>& cholesky)
      : symbolic_(cholesky.symbolic()),
        factor_(cholesky.blocks()),
        tiles_(cholesky.kernels()),
        inverse_(symbolic_.rows().size(), Block::Zero()) {}

  std::vector<Block> run() {
    for (int panel = symbolic_.panels() - 1; panel >= 0; --panel) {
      first_ = symbolic_.panelBegin(panel);
      width_ = symbolic_.panelWidth(panel);
      below_ = symbolic_.panelHeight(panel) - width_;
      rows_ = symbolic_.panelRows(panel) + width_;
      findRows();
      if (width_ == 1 && below_ <= kFew) {
        invertColumn();
        continue;
      }
      invertTriangle();
      scaleRows();
      invertRows();
      invertDiagonal();
    }
    return std::move(inverse_);
  }

 private:
  /** So few rows below a single column, as in graphs that are nearly chains, are not worth
   * tiles. */
  static constexpr int kFew = 4;

  using Operand = typename TileProducts<kSize>::Operand;

  const Block& factor(int row, int column) const {
    return factor_[symbolic_.panelEntry(first_ + column) + row];
  }
  Block& inverse(int row, int column) {
    return inverse_[symbolic_.panelEntry(first_ + column) + row];
  }
  Block& triangle(int row, int column) { return triangle_[row * width_ + column]; }
  Block& scaled(int row, int column) { return scaled_[row * width_ + column]; }

  /** Does all steps for a panel of one column. */
  void invertColumn() {
    const Block& inverse_factor = factor(0, 0);
    std::array<Block, kFew> y;
    for (int row = 0; row < below_; ++row) y[row].noalias() = factor(1 + row, 0) * inverse_factor;
    Block& diagonal = inverse(0, 0);
    diagonal.noalias() = inverse_factor.transpose() * inverse_factor;
    for (int row = 0; row < below_; ++row) {
      Block& block = inverse(1 + row, 0);
      for (int k = 0; k < below_; ++k) {
        const Block& z = inverse_[symbolic_.panelEntry(rows_[std::min(row, k)]) +
                                  positions_[positions_of_[std::min(row, k)] + std::max(row, k)]];
        if (row < k)
          block.noalias() -= z.transpose() * y[k];
        else
          block.noalias() -= z * y[k];
      }
      diagonal.noalias() -= y[row].transpose() * block;
    }
  }

  /** -L_JJ⁻¹. */
  void invertTriangle() {
    triangle_.resize(width_ * width_);
    for (int column = 0; column < width_; ++column) {
      triangle(column, column) = -factor(column, column);
      for (int row = column + 1; row < width_; ++row) {
        Block sum = Block::Zero();
        for (int k = column; k < row; ++k) sum.noalias() += factor(row, k) * triangle(k, column);
        triangle(row, column).noalias() = -factor(row, row) * sum;
      }
    }
  }

  /** Y. */
  void scaleRows() {
    scaled_.assign(below_ * width_, Block::Zero());
    const Block zero = Block::Zero();
    tiles_.subtract(
        below_, width_, width_,
        [&](int row, int k) {
          return Operand{factor(width_ + row, k), false};
        },
        [&](int column, int k) {
          return Operand{k < column ? zero : triangle(k, column), true};
        },
        [&](int row, int column) { return &scaled(row, column); });
  }

  /** Finds these rows in the panels of the rows below. */
  void findRows() {
    positions_.clear();
    positions_of_.resize(below_);
    for (int row = 0; row < below_; ++row) {
      const int panel = symbolic_.panelOf(rows_[row]);
      if (row > 0 && panel == symbolic_.panelOf(rows_[row - 1])) {
        positions_of_[row] = positions_of_[row - 1];
        continue;
      }
      positions_of_[row] = static_cast<int>(positions_.size()) - row;
      const int* const begin = symbolic_.panelRows(panel);
      const int* const end = begin + symbolic_.panelHeight(panel);
      const int* at = begin;
      for (int i = row; i < below_; ++i) {
        at = std::lower_bound(at, end, rows_[i]);
        positions_.push_back(static_cast<int>(at - begin));
      }
    }
  }

  /** A block of Z_RR. */
  Operand known(int row, int column) const {
    const int low = std::max(row, column), left = std::min(row, column);
    return {inverse_[symbolic_.panelEntry(rows_[left]) + positions_[positions_of_[left] + low]],
            row < column};
  }

  void invertRows() {
    tiles_.subtract(
        below_, width_, below_, [&](int row, int k) { return known(row, k); },
        [&](int column, int k) {
          return Operand{scaled(k, column), true};
        },
        [&](int row, int column) { return &inverse(width_ + row, column); });
  }

  void invertDiagonal() {
    for (int column = 0; column < width_; ++column)
      for (int row = column; row < width_; ++row)
        for (int k = row; k < width_; ++k)
          inverse(row, column).noalias() += triangle(k, row).transpose() * triangle(k, column);
    tiles_.subtract(
        width_, width_, below_,
        [&](int row, int k) {
          return Operand{scaled(k, row), true};
        },
        [&](int column, int k) {
          return Operand{inverse(width_ + k, column), true};
        },
        [&](int row, int column) { return row < column ? nullptr : &inverse(row, column); });
  }

  const SymbolicCholesky& symbolic_;
  const std::vector<Block>& factor_;
  TileProducts<kSize> tiles_;
  std::vector<Block> inverse_;
  int first_ = 0, width_ = 0, below_ = 0;  ///< of the current panel
  const int* rows_ = nullptr;              ///< those below it
  std::vector<Block> triangle_, scaled_;   ///< -L_JJ⁻¹ and Y, row by row
  std::vector<int> positions_, positions_of_;
};

}  // namespace

template <int kSize>
std::vector<typename BlockMatrix<kSize>::Block> selectedInverse(
    const BlockCholesky<kSize>& cholesky) {
  return Inversion<kSize>(cholesky).run();
}

template std::vector<BlockMatrix<3>::Block> selectedInverse(const BlockCholesky<3>&);
template std::vector<BlockMatrix<6>::Block> selectedInverse(const BlockCholesky<6>&);

}  // namespace lamp
