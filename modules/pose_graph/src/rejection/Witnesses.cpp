#include "rejection/Witnesses.h"

#include <set>
#include <tuple>

#include "rejection/LoopChances.h"
#include "robust/LoopNeighbourhoods.h"

namespace lamp {

std::vector<size_t> witnesses(const std::vector<DirectedLoop>& loops, const OdometryChains& chains,
                              const LoopChances& chances) {
  constexpr int kPlaceNodes = 20;
  constexpr double kMaxChance = 0.01;
  LoopNeighbourhoods neighbourhoods(chains, kPlaceNodes);
  for (const DirectedLoop& loop : loops) neighbourhoods.add(loop);
  std::set<LoopNeighbourhoods::Cell> places;
  std::vector<size_t> found;
  for (size_t i = 0; i < loops.size(); ++i) {
    if (places.count(neighbourhoods.cell(loops[i])) > 0) continue;
    const auto partners = neighbourhoods.nearest(loops[i], kMaxPartners);
    if (chances.ofPartners(loops[i], partners, kMaxChance) > kMaxChance) continue;
    places.insert(neighbourhoods.cell(loops[i]));
    found.push_back(i);
  }
  return found;
}

}  // namespace lamp
