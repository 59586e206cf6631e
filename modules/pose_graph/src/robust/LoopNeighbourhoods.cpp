#include "robust/LoopNeighbourhoods.h"

#include <algorithm>

namespace lamp {

std::vector<DirectedLoop> LoopNeighbourhoods::nearest(const DirectedLoop& loop, size_t most) const {
  struct Neighbour {
    int distance;
    const DirectedLoop* loop;
  };
  std::vector<Neighbour> neighbours;
  const auto [from_chain, to_chain, from, to] = cell(loop);
  const auto limit = static_cast<int>(nodes_);
  for (int64_t i = from - 1; i <= from + 1; ++i)
    for (int64_t j = to - 1; j <= to + 1; ++j) {
      const auto found = cells_.find({from_chain, to_chain, i, j});
      if (found == cells_.end()) continue;
      for (const DirectedLoop& other : found->second) {
        const int at_from = nodesBetween(loop.from, other.from);
        const int at_to = nodesBetween(loop.to, other.to);
        if (other.edge != loop.edge && at_from <= limit && at_to <= limit)
          neighbours.push_back({at_from + at_to, &other});
      }
    }
  const size_t count = std::min(most, neighbours.size());
  const auto nearer = [](const Neighbour& a, const Neighbour& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.loop->edge < b.loop->edge;
  };
  std::partial_sort(neighbours.begin(), neighbours.begin() + static_cast<std::ptrdiff_t>(count),
                    neighbours.end(), nearer);
  std::vector<DirectedLoop> result;
  for (size_t i = 0; i < count; ++i) result.push_back(*neighbours[i].loop);
  return result;
}

}  // namespace lamp
