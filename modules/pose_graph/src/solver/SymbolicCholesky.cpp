#include "solver/SymbolicCholesky.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

namespace lamp {

namespace {

/** Many short lists of numbers, without memory of their own for each. */
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

}  // namespace

SymbolicCholesky::SymbolicCholesky(int size, const std::vector<BlockPair>& pairs) : place_(size) {
  order(pairs);
  fillColumns(pairs);
  listRows();
  findTargets(pairs);
}

void SymbolicCholesky::order(const std::vector<BlockPair>& pairs) {
  if (size() == 0) return;
  std::vector<Eigen::Triplet<char>> entries;
  for (const BlockPair pair : pairs)
    entries.emplace_back(std::max(pair.row, pair.column), std::min(pair.row, pair.column), 1);
  for (int i = 0; i < size(); ++i) entries.emplace_back(i, i, 1);
  Eigen::SparseMatrix<char> lower(size(), size());
  lower.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> row_at_place;
  Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), row_at_place);
  for (int place = 0; place < size(); ++place) place_[row_at_place.indices()[place]] = place;
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
    if (columnEnd(column) - columnBegin(column) > 1) children.add(rows_[begin + 1], column);
  }
}

void SymbolicCholesky::listRows() {
  left_begin_.assign(size() + 1, 0);
  for (int column = 0; column < size(); ++column)
    for (int entry = columnBegin(column) + 1; entry < columnEnd(column); ++entry)
      ++left_begin_[rows_[entry] + 1];
  for (int row = 0; row < size(); ++row) left_begin_[row + 1] += left_begin_[row];
  left_.resize(left_begin_.back());
  std::vector<int> next(left_begin_.begin(), left_begin_.end() - 1);
  for (int column = 0; column < size(); ++column)
    for (int entry = columnBegin(column) + 1; entry < columnEnd(column); ++entry)
      left_[next[rows_[entry]]++] = {column, entry};
}

void SymbolicCholesky::findTargets(const std::vector<BlockPair>& pairs) {
  for (const BlockPair pair : pairs) {
    const int row = place_[pair.row], column = place_[pair.column];
    const auto begin = rows_.begin() + columnBegin(std::min(row, column));
    const auto end = rows_.begin() + columnEnd(std::min(row, column));
    const auto found = std::lower_bound(begin, end, std::max(row, column));
    targets_.push_back({static_cast<int>(found - rows_.begin()), row < column});
  }
}

int SymbolicCholesky::entry(int row, int column) const {
  const auto begin = rows_.begin() + columnBegin(column), end = rows_.begin() + columnEnd(column);
  return static_cast<int>(std::lower_bound(begin, end, row) - rows_.begin());
}

}  // namespace lamp
