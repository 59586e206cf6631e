#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamp {

/** An undirected graph of which many edges are there, a row of bits a vertex. */
class ConsistencyGraph {
 public:
  explicit ConsistencyGraph(size_t vertices)
      : vertices_(vertices), words_((vertices + 63) / 64), bits_(vertices * words_, 0) {}

  size_t size() const { return vertices_; }
  size_t words() const { return words_; }
  /** Two different vertices: a loop would be a clique without end. */
  void connect(size_t a, size_t b) {
    set(a, b);
    set(b, a);
  }
  bool connected(size_t a, size_t b) const { return row(a)[b / 64] >> (b % 64) & 1; }
  const uint64_t* row(size_t a) const { return bits_.data() + a * words_; }

 private:
  void set(size_t a, size_t b) { bits_[a * words_ + b / 64] |= uint64_t{1} << (b % 64); }

  size_t vertices_, words_;
  std::vector<uint64_t> bits_;
};

/** A maximum clique among the vertices that are `allowed` (one entry a vertex), ascending; exact
 * unless the search ran out of branches. A greedy clique from the vertices of highest core number
 * comes first; it then bounds the search (Rossi et al. 2014, as in TEASER++). */
std::vector<uint32_t> maximumClique(const ConsistencyGraph& graph,
                                    const std::vector<bool>& allowed);

}  // namespace lamp
