#include "solver/EliminationOrder.h"

#include <metis.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <csignal>
#include <mutex>
#include <new>

namespace lamp {

namespace {

/** The neighbours of each row, ascending, one row after the other. */
struct Neighbours {
  Neighbours(int size, const std::vector<BlockPair>& pairs)
      : begin(size + 1), rows(2 * pairs.size()) {
    for (const BlockPair pair : pairs) {
      ++begin[pair.row + 1];
      ++begin[pair.column + 1];
    }
    for (int row = 0; row < size; ++row) begin[row + 1] += begin[row];
    std::vector<idx_t> next(begin.begin(), begin.end() - 1);
    for (const BlockPair pair : pairs) {
      rows[next[pair.row]++] = pair.column;
      rows[next[pair.column]++] = pair.row;
    }
    for (int row = 0; row < size; ++row)
      std::sort(rows.begin() + begin[row], rows.begin() + begin[row + 1]);
  }

  std::vector<idx_t> begin, rows;
};

}  // namespace

std::vector<int> minimumDegreeOrder(int size, const std::vector<BlockPair>& pairs) {
  std::vector<int> place(size);
  if (size == 0) return place;
  const Neighbours neighbours(size, pairs);
  Eigen::SparseMatrix<char> lower(size, size);
  lower.reserve(size + static_cast<Eigen::Index>(pairs.size()));
  for (int column = 0; column < size; ++column) {
    lower.startVec(column);
    lower.insertBack(column, column) = 1;
    for (idx_t at = neighbours.begin[column]; at < neighbours.begin[column + 1]; ++at)
      if (const idx_t row = neighbours.rows[at]; row > column) lower.insertBack(row, column) = 1;
  }
  lower.finalize();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> row_at_place;
  Eigen::AMDOrdering<int>()(lower.selfadjointView<Eigen::Lower>(), row_at_place);
  for (int i = 0; i < size; ++i) place[row_at_place.indices()[i]] = i;
  return place;
}

std::vector<int> nestedDissectionOrder(int size, const std::vector<BlockPair>& pairs) {
  if (pairs.empty()) return minimumDegreeOrder(size, pairs);  // METIS needs an edge
  // METIS seeds the C library's random generator and draws from it: one call at a time.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  Neighbours neighbours(size, pairs);
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  idx_t rows = size;
  std::vector<idx_t> row_at_place(size), place(size);
  const int status = METIS_NodeND(&rows, neighbours.begin.data(), neighbours.rows.data(), nullptr,
                                  options, row_at_place.data(), place.data());
  if (status == METIS_ERROR_MEMORY) throw std::bad_alloc();
  if (status == METIS_OK) return {place.begin(), place.end()};
  // METIS takes SIGTERM for an error of its own: pass it on, and do without METIS.
  std::raise(SIGTERM);
  return minimumDegreeOrder(size, pairs);
}

}  // namespace lamp
