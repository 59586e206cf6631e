#include "lamp/pose_graph/ChanceAgreement.h"

#include <algorithm>
#include <cmath>

#include "rejection/LoopCycles.h"
#include "rejection/PoseVolume.h"
#include "robust/LoopNeighbourhoods.h"

IMPLEMENTS_MRPT_OBJECT(ChanceAgreement, OutlierRejection, lamp)

namespace lamp {

namespace {

/** Of all false loops together, so many may be admitted by chance. */
constexpr double kExpected = 0.05;
/** More partners tell nothing new. */
constexpr size_t kMaxPartners = 30;

struct DoubtfulLoop {
  DirectedLoop loop;
  double by_odometry, allowed;  ///< chances
};

/** The chance that what is seen of a loop is seen of a false one. */
class Chance {
 public:
  Chance(const PoseGraph& graph, const OdometryChains& chains)
      : chains_(chains), volume_(graph, chains) {}

  double ofOdometry(const DirectedLoop& loop, const RelativePose& odometry) const {
    return volume_.chance(odometry.covariance + loop.measured.covariance);
  }

  /** The least k · min(1, λ)^s of the k nearest partners: far ones, of which odometry knows little,
   * must not hide what the near ones say. \param enough at which the search ends. */
  double ofPartners(const DirectedLoop& loop, const std::vector<DirectedLoop>& partners,
                    double enough) const {
    double expected = 0, least = 1.0;
    int agreeing = 0;
    for (size_t k = 0; k < partners.size() && least > enough; ++k) {
      const Closure closure = cycle(loop, partners[k], chains_);
      expected += volume_.chance(closure.covariance);
      agreeing += closure.distance2() <= volume_.usualThreshold();
      least =
          std::min(least, static_cast<double>(k + 1) * std::pow(std::min(1.0, expected), agreeing));
    }
    return least;
  }

 private:
  const OdometryChains& chains_;
  const PoseVolume volume_;
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
  const Chance chance(graph, chains);
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
