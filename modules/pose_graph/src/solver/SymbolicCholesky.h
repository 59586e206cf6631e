#pragma once

#include <vector>

#include "solver/BlockMatrix.h"

namespace lamp {

/** Where the Cholesky factor of a sparse symmetric block matrix has blocks, after rows and columns
 * are reordered for little fill-in: by approximate minimum degree, or by nested dissection where
 * that pays.
 *
 * Depends on the structure only: computed once for many matrices. Numbering: "row" is a row of the
 * matrix as given, "place" its position in the order of elimination. Adjacent columns with the same
 * rows below them make a panel (a supernode, or a part of one). */
class SymbolicCholesky {
 public:
  /** \param max_panel_width in columns. */
  SymbolicCholesky(int size, const std::vector<BlockPair>& pairs, int max_panel_width);

  int size() const { return static_cast<int>(place_.size()); }
  int place(int row) const { return place_[row]; }

  /** Entries of a column of the factor in rows(): the diagonal, then downwards. */
  int columnBegin(int column) const { return column_begin_[column]; }
  int columnEnd(int column) const { return column_begin_[column + 1]; }
  /** The entry of a row in a column, both by place, on the diagonal or below; it must exist. */
  int entry(int row, int column) const;
  /** Places of the rows of all blocks of the factor, column by column. */
  const std::vector<int>& rows() const { return rows_; }

  int panels() const { return static_cast<int>(panels_.size()); }
  int panelOf(int column) const { return panel_of_[column]; }
  /** Columns of a panel. */
  int panelBegin(int panel) const { return panels_[panel].begin; }
  int panelWidth(int panel) const { return panels_[panel].width; }
  /** Places of a panel's rows: those of its first column. The panel's own columns come first. */
  const int* panelRows(int panel) const { return rows_.data() + panels_[panel].entry; }
  int panelHeight(int panel) const { return panels_[panel].height; }
  /** The entry that the first of panelRows() would have in a column; the other rows follow. Those
   * above the diagonal are not stored. */
  int panelEntry(int column) const { return panel_entry_[column]; }

  /** Where each of the pairs lies in the factor. */
  struct Target {
    int entry;        ///< in rows()
    bool transposed;  ///< the factor holds the pair's transpose
  };
  const std::vector<Target>& targets() const { return targets_; }

  /** How many products of blocks a factorisation takes. */
  double products() const { return products_; }

 private:
  struct Panel {
    int begin, width, height, entry;
  };

  SymbolicCholesky() = default;
  void eliminate(std::vector<int> place, const std::vector<BlockPair>& pairs);
  void fillColumns(const std::vector<BlockPair>& pairs);
  void joinPanels(int max_width);
  void findTargets(const std::vector<BlockPair>& pairs);

  std::vector<int> place_;
  std::vector<int> column_begin_, rows_;
  std::vector<Panel> panels_;
  std::vector<int> panel_of_, panel_entry_;
  std::vector<Target> targets_;
  double products_ = 0;
};

}  // namespace lamp
