#include "solver/SymbolicCholesky.h"

#include <algorithm>
#include <utility>

#include "solver/EliminationOrder.h"

namespace lamp {

namespace {

/** With this many products of blocks per column, nested dissection may save more time than it
 * takes. */
constexpr double kWorthDissecting = 300;

/** Many short lists of numbers that share their memory. */
class Lists {
 public:
  explicit Lists(int count) : first_(count, -1) {}

  void add(int list, int value) {
    links_.push_back({value, first_[list]});
    first_[list] = static_cast<int>(links_.size()) - 1;
  }
  template <class Visit>
  void forEach(int list, Visit visit) const {
    for (int at = first_[list]; at >= 0; at = links_[at].next) visit(links_[at].value);
  }

 private:
  struct Link {
    int value, next;
  };
  std::vector<int> first_;
  std::vector<Link> links_;
};

/** The elimination tree: by place, the column that each column's elimination changes first, -1 for
 * none (Liu, "A compact row storage scheme for Cholesky factors using elimination trees", ACM TOMS
 * 1986). */
std::vector<int> eliminationTree(const std::vector<int>& place,
                                 const std::vector<BlockPair>& pairs) {
  const int size = static_cast<int>(place.size());
  Lists left(size);
  for (const BlockPair pair : pairs) {
    const int a = place[pair.row], b = place[pair.column];
    left.add(std::max(a, b), std::min(a, b));
  }
  std::vector<int> parent(size, -1), ancestor(size, -1);
  for (int column = 0; column < size; ++column)
    left.forEach(column, [&](int at) {
      while (ancestor[at] >= 0 && ancestor[at] != column) at = std::exchange(ancestor[at], column);
      if (ancestor[at] >= 0) return;
      parent[at] = ancestor[at] = column;
    });
  return parent;
}

/** New places for the columns, such that each subtree is in one piece with its root last. The
 * elimination does the same work, but columns that can make one panel are side by side. */
std::vector<int> postorder(const std::vector<int>& parent) {
  const int size = static_cast<int>(parent.size());
  std::vector<int> subtree(size, 1), place(size), last_free(size);
  for (int column = 0; column < size; ++column)
    if (parent[column] >= 0) subtree[parent[column]] += subtree[column];
  int last_root = size - 1;
  for (int column = size - 1; column >= 0; --column) {
    int& last = parent[column] < 0 ? last_root : last_free[parent[column]];
    place[column] = last;
    last_free[column] = last - 1;
    last -= subtree[column];
  }
  return place;
}

}  // namespace

SymbolicCholesky::SymbolicCholesky(int size, const std::vector<BlockPair>& pairs,
                                   int max_panel_width) {
  eliminate(minimumDegreeOrder(size, pairs), pairs);
  if (products_ > kWorthDissecting * size) {
    SymbolicCholesky dissected;
    dissected.eliminate(nestedDissectionOrder(size, pairs), pairs);
    if (dissected.products_ < products_) *this = std::move(dissected);
  }
  joinPanels(max_panel_width);
  findTargets(pairs);
}

void SymbolicCholesky::eliminate(std::vector<int> place, const std::vector<BlockPair>& pairs) {
  const std::vector<int> new_place = postorder(eliminationTree(place, pairs));
  for (int& at : place) at = new_place[at];
  place_ = std::move(place);
  fillColumns(pairs);
}

void SymbolicCholesky::fillColumns(const std::vector<BlockPair>& pairs) {
  Lists below(size()), children(size());
  for (const BlockPair pair : pairs) {
    const int a = place_[pair.row], b = place_[pair.column];
    below.add(std::min(a, b), std::max(a, b));
  }
  // Eliminating a column joins its rows: its first row's column inherits all of them.
  std::vector<int> seen_by(size(), -1);
  column_begin_.assign(1, 0);
  for (int column = 0; column < size(); ++column) {
    const auto begin = static_cast<std::ptrdiff_t>(rows_.size());
    const auto add = [&](int row) {
      if (seen_by[row] == column) return;
      seen_by[row] = column;
      rows_.push_back(row);
    };
    add(column);
    below.forEach(column, add);
    children.forEach(column, [&](int child) {
      for (int entry = columnBegin(child) + 1; entry < columnEnd(child); ++entry) add(rows_[entry]);
    });
    std::sort(rows_.begin() + begin, rows_.end());
    column_begin_.push_back(static_cast<int>(rows_.size()));
    const double height = columnEnd(column) - columnBegin(column);
    products_ += 0.5 * height * (height + 1);
    if (height > 1) children.add(rows_[begin + 1], column);
  }
}

void SymbolicCholesky::joinPanels(int max_width) {
  const auto height = [&](int column) { return columnEnd(column) - columnBegin(column); };
  const auto continues = [&](int column) {
    return panels_.back().width < max_width && height(column - 1) == height(column) + 1 &&
           rows_[columnBegin(column - 1) + 1] == column;
  };
  for (int column = 0; column < size(); ++column) {
    if (column == 0 || !continues(column))
      panels_.push_back({column, 0, height(column), columnBegin(column)});
    Panel& panel = panels_.back();
    panel_of_.push_back(panels() - 1);
    panel_entry_.push_back(columnBegin(column) - panel.width++);
  }
}

void SymbolicCholesky::findTargets(const std::vector<BlockPair>& pairs) {
  for (const BlockPair pair : pairs) {
    const int row = place_[pair.row], column = place_[pair.column];
    targets_.push_back({entry(std::max(row, column), std::min(row, column)), row < column});
  }
}

int SymbolicCholesky::entry(int row, int column) const {
  const auto begin = rows_.begin() + columnBegin(column), end = rows_.begin() + columnEnd(column);
  return static_cast<int>(std::lower_bound(begin, end, row) - rows_.begin());
}

}  // namespace lamp
