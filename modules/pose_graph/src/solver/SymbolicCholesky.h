#pragma once

#include <vector>

#include "solver/BlockMatrix.h"

namespace lamp {

/** Where the Cholesky factor of a sparse symmetric block matrix has blocks, after rows and columns
 * are reordered for little fill-in (approximate minimum degree on blocks).
 *
 * Depends on the structure only: computed once for many matrices. Numbering: "row" is a row of the
 * matrix as given, "place" its position in the order of elimination. */
class SymbolicCholesky {
 public:
  SymbolicCholesky(int size, const std::vector<BlockPair>& pairs);

  /** A block of the factor that lies left of the diagonal of some row. */
  struct LeftBlock {
    int column;  ///< its place
    int entry;   ///< in rows()
  };

  int size() const { return static_cast<int>(place_.size()); }
  int place(int row) const { return place_[row]; }

  /** Entries of a column of the factor in rows(): the diagonal, then downwards. */
  int columnBegin(int column) const { return column_begin_[column]; }
  int columnEnd(int column) const { return column_begin_[column + 1]; }
  /** Of a row in a column, both by place, the row below or on the diagonal; it must be there. */
  int entry(int row, int column) const;
  /** Places of the rows of all blocks of the factor, column by column. */
  const std::vector<int>& rows() const { return rows_; }

  /** Blocks of a row of the factor left of the diagonal, from left to right. */
  const LeftBlock* leftBegin(int row) const { return left_.data() + left_begin_[row]; }
  const LeftBlock* leftEnd(int row) const { return left_.data() + left_begin_[row + 1]; }

  /** Where each of the pairs lies in the factor. */
  struct Target {
    int entry;        ///< in rows()
    bool transposed;  ///< the factor holds the pair's transpose
  };
  const std::vector<Target>& targets() const { return targets_; }

 private:
  void order(const std::vector<BlockPair>& pairs);
  void fillColumns(const std::vector<BlockPair>& pairs);
  void listRows();
  void findTargets(const std::vector<BlockPair>& pairs);

  std::vector<int> place_;
  std::vector<int> column_begin_, rows_;
  std::vector<int> left_begin_;
  std::vector<LeftBlock> left_;
  std::vector<Target> targets_;
};

}  // namespace lamp
