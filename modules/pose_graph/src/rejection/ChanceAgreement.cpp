#include "lamp/pose_graph/ChanceAgreement.h"

#include <algorithm>
#include <cmath>

#include "rejection/LoopChances.h"
#include "rejection/LoopCycles.h"
#include "robust/LoopNeighbourhoods.h"

IMPLEMENTS_MRPT_OBJECT(ChanceAgreement, OutlierRejection, lamp)

namespace lamp {

namespace {

/** The number of false loops, of all together, that may be expected to pass by chance. */
constexpr double kExpected = 0.05;

struct DoubtfulLoop {
  DirectedLoop loop;
  double by_odometry, allowed;  ///< chances
};

}  // namespace

void ChanceAgreementOptions::visit(OptionVisitor& v) {
  v("max_chance", max_chance, "",
    "a loop closure stays out if a false one would agree this well with odometry and neighbouring "
    "loop closures with more than this probability",
    kShare);
  v("partner_nodes", partner_nodes, "key nodes",
    "two loop closures are compared if both their ends are this close in sequence", {1});
}

Admission ChanceAgreement::reject(const PoseGraph& graph, Admission before) {
  const double of_all = std::min(1.0, kExpected / before.false_loops);
  before.max_chance = of_all > 0 ? of_all : options_.max_chance;
  const OdometryChains chains(graph);
  const LoopChances chance(graph, chains);
  LoopNeighbourhoods neighbourhoods(chains, options_.partner_nodes);
  std::vector<DoubtfulLoop> doubtful;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.isLoopClosure() || !before.admitted[e]) continue;
    const DirectedLoop loop = directed(e, edge, graph.planar());
    neighbourhoods.add(loop);
    if (edge.pinned) continue;
    const auto odometry = chains.between(loop.from, loop.to);
    const bool strangers = !odometry && edge.betweenRobots();
    const double by_odometry = odometry ? chance.ofOdometry(loop, *odometry) : 1.0;
    const double allowed =
        strangers ? std::min(options_.max_chance, before.max_chance) : before.max_chance;
    if (by_odometry > allowed) doubtful.push_back({loop, by_odometry, allowed});
  }
  for (const auto& [loop, by_odometry, allowed] : doubtful) {
    const auto partners = neighbourhoods.nearest(loop, kMaxPartners);
    const double together = by_odometry * chance.ofPartners(loop, partners, allowed / by_odometry);
    if (together <= allowed) continue;
    before.admitted[loop.edge] = false;
    before.waiting[loop.edge] = true;
    before.likely[loop.edge] = together <= options_.max_chance;
  }
  return before;
}

}  // namespace lamp
