#include "lamp/pose_graph/ChanceAgreement.h"

#include <algorithm>
#include <cmath>

#include "lamp/core/ChiSquare.h"
#include "rejection/LoopCycles.h"
#include "rejection/PoseVolume.h"
#include "robust/LoopNeighbourhoods.h"

IMPLEMENTS_MRPT_OBJECT(ChanceAgreement, OutlierRejection, lamp)

namespace lamp {

namespace {

/** Share of true loops that lie in their ellipsoids. */
constexpr double kInside = 0.99;
/** More partners tell nothing new. */
constexpr size_t kMaxPartners = 30;

/** The chance that what is seen of a loop is seen of a false one. */
class Chance {
 public:
  Chance(const PoseGraph& graph, const OdometryChains& chains)
      : chains_(chains),
        volume_(graph, chains),
        threshold_(chiSquareQuantile(kInside, graph.planar() ? 3 : 6)) {}

  double ofOdometry(const DirectedLoop& loop, const RelativePose& odometry) const {
    return volume_.chance(odometry.covariance + loop.measured.covariance, threshold_);
  }

  /** The least k · min(1, λ)^s of the k nearest partners: far ones, of which odometry knows little,
   * must not hide what the near ones say. \param enough at which the search ends. */
  double ofPartners(const DirectedLoop& loop, const std::vector<DirectedLoop>& partners,
                    double enough) const {
    double expected = 0, least = 1.0;
    int agreeing = 0;
    for (size_t k = 0; k < partners.size() && least > enough; ++k) {
      const Closure closure = cycle(loop, partners[k], chains_);
      expected += volume_.chance(closure.covariance, threshold_);
      agreeing += closure.distance2() <= threshold_;
      least =
          std::min(least, static_cast<double>(k + 1) * std::pow(std::min(1.0, expected), agreeing));
    }
    return least;
  }

 private:
  const OdometryChains& chains_;
  const PoseVolume volume_;
  const double threshold_;
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

void ChanceAgreement::reject(const PoseGraph& graph, std::vector<bool>& admitted) {
  const OdometryChains chains(graph);
  const Chance chance(graph, chains);
  LoopNeighbourhoods neighbourhoods(chains, options_.partner_nodes);
  std::vector<std::pair<DirectedLoop, double>> doubtful;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.isLoopClosure() || !admitted[e]) continue;
    const DirectedLoop loop = directed(e, edge, graph.planar());
    neighbourhoods.add(loop);
    const auto odometry = chains.between(loop.from, loop.to);
    if (!odometry || edge.pinned) continue;
    const double by_odometry = chance.ofOdometry(loop, *odometry);
    if (by_odometry > options_.max_chance) doubtful.emplace_back(loop, by_odometry);
  }
  for (const auto& [loop, by_odometry] : doubtful) {
    const double enough = options_.max_chance / by_odometry;
    const auto partners = neighbourhoods.nearest(loop, kMaxPartners);
    if (chance.ofPartners(loop, partners, enough) > enough) admitted[loop.edge] = false;
  }
}

}  // namespace lamp
