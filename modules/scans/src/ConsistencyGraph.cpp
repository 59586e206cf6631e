#include "lamp/scans/ConsistencyGraph.h"

#include <algorithm>
#include <optional>

#include "VectorKernels.h"

namespace lamp {

namespace {

using Bits = std::vector<uint64_t>;

LAMP_FOR_SEVERAL_INSTRUCTION_SETS
size_t count(const uint64_t* a, const uint64_t* b, size_t words) {
  size_t sum = 0;
  for (size_t w = 0; w < words; ++w) sum += static_cast<size_t>(__builtin_popcountll(a[w] & b[w]));
  return sum;
}

/** Calls `use` with each set bit, ascending. */
template <class Use>
void forBits(const Bits& bits, const Use& use) {
  for (size_t w = 0; w < bits.size(); ++w)
    for (uint64_t rest = bits[w]; rest != 0; rest &= rest - 1)
      use(static_cast<uint32_t>(64 * w + static_cast<size_t>(__builtin_ctzll(rest))));
}

void erase(uint32_t v, Bits& bits) {
  bits[v / 64] &= ~(uint64_t{1} << (v % 64));
}

class Search {
 public:
  Search(const ConsistencyGraph& graph, const std::vector<bool>& allowed)
      : graph_(graph), alive_(graph.words(), 0) {
    for (uint32_t v = 0; v < graph.size(); ++v)
      if (allowed[v]) alive_[v / 64] |= uint64_t{1} << (v % 64);
    findCores();
  }

  std::vector<uint32_t> run() {
    growFromTheCores();
    // Vertices in ascending core number: the clique that a vertex leads lies among its later ones.
    for (size_t k = 0; k < order_.size(); ++k) {
      const uint32_t v = order_[k];
      erase(v, alive_);
      if (core_[v] < best_.size()) continue;
      std::vector<uint32_t> clique{v};
      branch(clique, common(alive_, v));
    }
    std::sort(best_.begin(), best_.end());
    return best_;
  }

 private:
  /** Core numbers by taking away the vertex of lowest degree, again and again (Batagelj, Zaversnik
   * 2003). */
  void findCores() {
    core_.assign(graph_.size(), 0);
    std::vector<size_t> degree(graph_.size(), 0);
    std::vector<std::vector<uint32_t>> of_degree;
    forBits(alive_, [&](uint32_t v) {
      degree[v] = count(graph_.row(v), alive_.data(), graph_.words());
      if (of_degree.size() <= degree[v]) of_degree.resize(degree[v] + 1);
      of_degree[degree[v]].push_back(v);
    });
    Bits left = alive_;
    size_t core = 0;
    for (size_t d = 0; d < of_degree.size();) {
      if (of_degree[d].empty()) {
        ++d;
        continue;
      }
      const uint32_t v = of_degree[d].back();
      of_degree[d].pop_back();
      if (degree[v] != d || !(left[v / 64] >> (v % 64) & 1)) continue;  // listed anew, or gone
      core = std::max(core, d);
      core_[v] = core;
      order_.push_back(v);
      erase(v, left);
      forBits(common(left, v), [&](uint32_t u) { of_degree[--degree[u]].push_back(u); });
      if (d > 0) --d;
    }
  }

  Bits common(const Bits& bits, uint32_t v) const {
    Bits result(bits);
    for (size_t w = 0; w < result.size(); ++w) result[w] &= graph_.row(v)[w];
    return result;
  }

  struct Choice {
    uint32_t vertex;
    size_t kept;  ///< neighbours among the candidates
  };
  /** The candidate that keeps most of the others, the first of equals. */
  std::optional<Choice> mostConnected(const Bits& candidates) const {
    std::optional<Choice> best;
    forBits(candidates, [&](uint32_t v) {
      const size_t kept = count(graph_.row(v), candidates.data(), candidates.size());
      if (!best || kept > best->kept) best = Choice{v, kept};
    });
    return best;
  }

  /** Greedy cliques: always on to the vertex that keeps most candidates. */
  void growFromTheCores() {
    const size_t seeds = std::min(kSeeds, order_.size());
    for (size_t k = 0; k < seeds; ++k) {
      const uint32_t seed = order_[order_.size() - 1 - k];
      if (core_[seed] < best_.size()) return;
      std::vector<uint32_t> clique{seed};
      Bits candidates = common(alive_, seed);
      while (const auto next = mostConnected(candidates)) {
        clique.push_back(next->vertex);
        candidates = common(candidates, next->vertex);
      }
      if (clique.size() > best_.size()) best_ = clique;
    }
  }

  void branch(std::vector<uint32_t>& clique, Bits candidates) {
    if (clique.size() > best_.size()) best_ = clique;
    size_t left = 0;
    for (const uint64_t word : candidates) left += static_cast<size_t>(__builtin_popcountll(word));
    while (left > 0 && clique.size() + left > best_.size()) {
      if (branches_left_ == 0) return;
      --branches_left_;
      const auto [next, kept] = *mostConnected(candidates);
      clique.push_back(next);
      if (clique.size() + kept > best_.size()) branch(clique, common(candidates, next));
      clique.pop_back();
      erase(next, candidates);
      --left;
    }
  }

  static constexpr size_t kSeeds = 12, kMostBranches = 500;

  const ConsistencyGraph& graph_;
  size_t branches_left_ = kMostBranches;
  Bits alive_;
  std::vector<size_t> core_;
  std::vector<uint32_t> order_;  ///< vertices in ascending core number
  std::vector<uint32_t> best_;
};

}  // namespace

std::vector<uint32_t> maximumClique(const ConsistencyGraph& graph,
                                    const std::vector<bool>& allowed) {
  return Search(graph, allowed).run();
}

}  // namespace lamp
