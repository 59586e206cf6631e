#include "lamp/scans/ConsistencyGraph.h"

#include <algorithm>

#include "VectorKernels.h"

namespace lamp {

namespace {

using Bits = std::vector<uint64_t>;

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
      branch(clique, common(alive_, v), countCommon(graph_.row(v), alive_.data(), graph_.words()));
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
      degree[v] = countCommon(graph_.row(v), alive_.data(), graph_.words());
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

  /** Greedy cliques: always on to the vertex that keeps most candidates. */
  void growFromTheCores() {
    const size_t seeds = std::min(kSeeds, order_.size());
    for (size_t k = 0; k < seeds; ++k) {
      const uint32_t seed = order_[order_.size() - 1 - k];
      if (core_[seed] < best_.size()) return;
      std::vector<uint32_t> clique = grownFrom(seed);
      if (clique.size() > best_.size()) best_ = std::move(clique);
    }
  }

  std::vector<uint32_t> grownFrom(uint32_t seed) const {
    std::vector<uint32_t> clique{seed}, candidates, left;
    Bits set = common(alive_, seed);
    // For each candidate, how many it is connected with; those that go are taken off one by one.
    std::vector<size_t> kept(graph_.size());
    forBits(set, [&](uint32_t v) {
      candidates.push_back(v);
      kept[v] = countCommon(graph_.row(v), set.data(), set.size());
    });
    while (!candidates.empty()) {
      const uint32_t next =
          *std::max_element(candidates.begin(), candidates.end(),
                            [&](uint32_t a, uint32_t b) { return kept[a] < kept[b]; });
      clique.push_back(next);
      set = common(set, next);
      left.clear();
      for (const uint32_t v : candidates)
        if (graph_.connected(v, next))
          left.push_back(v);
        else
          forBits(common(set, v), [&](uint32_t u) { --kept[u]; });
      candidates.swap(left);
    }
    return clique;
  }

  /** \param left how many the candidates are. */
  void branch(std::vector<uint32_t>& clique, Bits candidates, size_t left) {
    if (clique.size() > best_.size()) best_ = clique;
    while (left > 0 && clique.size() + left > best_.size()) {
      if (branches_left_ == 0) return;
      --branches_left_;
      const auto [next, kept] = mostConnected(graph_.row(0), graph_.words(), candidates.data());
      clique.push_back(next);
      if (clique.size() + kept > best_.size()) branch(clique, common(candidates, next), kept);
      clique.pop_back();
      erase(next, candidates);
      --left;
    }
  }

  static constexpr size_t kSeeds = 12, kMaxBranches = 500;

  const ConsistencyGraph& graph_;
  size_t branches_left_ = kMaxBranches;
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
