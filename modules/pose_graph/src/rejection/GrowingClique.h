#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamp {

/** The largest set of vertices that are all joined to one another, of a graph that grows.
 *
 * A new vertex makes the largest clique larger by one at most, and only by being in it. So only its
 * neighbours are searched: branch and bound with greedy colouring (Tomita, Seki, DMTCS 2003), exact
 * within a number of steps; beyond it the best found so far stays. */
class GrowingClique {
 public:
  explicit GrowingClique(size_t max_steps) : max_steps_(max_steps) {}

  /** Adds the next vertex. \param neighbours one flag for each vertex before it. */
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
  std::vector<std::vector<bool>> rows_;  ///< of each vertex: who of those before it is joined
  std::vector<int> best_;
  size_t steps_ = 0;
  bool exact_ = true;
};

}  // namespace lamp
