#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "rejection/LoopCycles.h"

namespace lamp {

/** Finds loop closures between the same two chains by where their ends are. */
class LoopNeighbourhoods {
 public:
  /** \param chains must outlive this.
   * \param nodes how many key nodes apart both ends of neighbours may lie. */
  LoopNeighbourhoods(const OdometryChains& chains, int nodes)
      : chains_(chains), nodes_(static_cast<uint32_t>(nodes)) {}

  /** Two chains, and the place along each in steps of `nodes`. */
  using Cell = std::tuple<int, int, int64_t, int64_t>;

  Cell cell(const DirectedLoop& loop) const {
    return {chains_.chain(loop.from), chains_.chain(loop.to), loop.from.index / nodes_,
            loop.to.index / nodes_};
  }

  void add(const DirectedLoop& loop) { cells_[cell(loop)].push_back(loop); }

  /** Up to `most` of the nearest neighbours, the nearest first. */
  std::vector<DirectedLoop> nearest(const DirectedLoop& loop, size_t most) const;

 private:
  const OdometryChains& chains_;
  const uint32_t nodes_;
  std::map<Cell, std::vector<DirectedLoop>> cells_;
};

}  // namespace lamp
