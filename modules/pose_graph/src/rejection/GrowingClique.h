#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamp {

/** The largest clique of a growing graph: the largest set of vertices that are all joined to one
 * another.
 *
 * A new vertex enlarges it by one at most, and only by being in it. So only the new vertex's
 * neighbours are searched, by branch and bound with greedy colouring (Tomita, Seki, DMTCS 2003).
 * The search is exact within a limit of steps; beyond that the best clique found so far stays. */
class GrowingClique {
 public:
  explicit GrowingClique(size_t max_steps) : max_steps_(max_steps) {}

  /** Adds the next vertex. \param neighbours one flag per earlier vertex. */
  void add(const std::vector<bool>& neighbours);

  size_t size() const { return rows_.size(); }
  /** Vertices of the clique, ascending. */
  const std::vector<int>& clique() const { return best_; }
  /** Whether no search has run out of steps. */
  bool exact() const { return exact_; }

 private:
  void expand(std::vector<int>& chosen, const std::vector<int>& candidates);
  bool joined(int a, int b) const { return a < b ? rows_[b][a] : rows_[a][b]; }

  const size_t max_steps_;
  std::vector<std::vector<bool>> rows_;  ///< by vertex: which earlier ones are joined to it
  std::vector<int> best_;
  size_t steps_ = 0;
  bool exact_ = true;
};

}  // namespace lamp
