#include "lamp/pose_graph/ChanceAgreement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "LoopCycles.h"
#include "PoseVolume.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/InitialGuess.h"

IMPLEMENTS_MRPT_OBJECT(ChanceAgreement, OutlierRejection, lamp)

namespace lamp {

namespace {

/** Share of true loops that lie in their ellipsoids. */
constexpr double kInside = 0.99;
/** More partners tell nothing new. */
constexpr size_t kMostPartners = 30;

/** Loops of the same two chains, by where their ends are, in steps of `nodes`. */
class Neighbourhoods {
 public:
  Neighbourhoods(const OdometryChains& chains, int nodes)
      : chains_(chains), nodes_(static_cast<uint32_t>(nodes)) {}

  void add(const DirectedLoop& loop) { cells_[cell(loop)].push_back(loop); }

  /** Those with both ends near; the nearest ones, if they are many. */
  std::vector<DirectedLoop> near(const DirectedLoop& loop) const {
    std::vector<DirectedLoop> result;
    auto [from_chain, to_chain, from, to] = cell(loop);
    for (int64_t i = from - 1; i <= from + 1; ++i)
      for (int64_t j = to - 1; j <= to + 1; ++j) {
        const auto found = cells_.find({from_chain, to_chain, i, j});
        if (found == cells_.end()) continue;
        for (const DirectedLoop& other : found->second)
          if (other.edge != loop.edge && distance(loop, other) <= static_cast<int>(2 * nodes_) &&
              std::max(nodesBetween(loop.from, other.from), nodesBetween(loop.to, other.to)) <=
                  static_cast<int>(nodes_))
            result.push_back(other);
      }
    std::stable_sort(result.begin(), result.end(),
                     [&](const DirectedLoop& a, const DirectedLoop& b) {
                       return distance(loop, a) < distance(loop, b);
                     });
    if (result.size() > kMostPartners) result.erase(result.begin() + kMostPartners, result.end());
    return result;
  }

 private:
  using Cell = std::tuple<int, int, int64_t, int64_t>;

  static int distance(const DirectedLoop& a, const DirectedLoop& b) {
    return nodesBetween(a.from, b.from) + nodesBetween(a.to, b.to);
  }
  Cell cell(const DirectedLoop& loop) const {
    return {chains_.chain(loop.from), chains_.chain(loop.to), loop.from.index / nodes_,
            loop.to.index / nodes_};
  }

  const OdometryChains& chains_;
  const uint32_t nodes_;
  std::map<Cell, std::vector<DirectedLoop>> cells_;
};

/** The chance that what is seen of a loop is seen of a false one. */
class Chance {
 public:
  Chance(const PoseGraph& graph, const OdometryChains& chains)
      : chains_(chains),
        volume_(initialGuess(graph), graph.planar()),
        threshold_(chiSquareQuantile(kInside, graph.planar() ? 3 : 6)) {}

  double ofOdometry(const DirectedLoop& loop, const RelativePose& odometry) const {
    return volume_.chance(odometry.covariance + loop.measured.covariance, threshold_);
  }

  /** min(1, λ)^s */
  double ofPartners(const DirectedLoop& loop, const std::vector<DirectedLoop>& partners) const {
    double expected = 0;
    int agreeing = 0;
    for (const DirectedLoop& partner : partners) {
      const Closure closure = cycle(loop, partner, chains_);
      expected += volume_.chance(closure.covariance, threshold_);
      agreeing += closure.distance2() <= threshold_;
    }
    return std::pow(std::min(1.0, expected), agreeing);
  }

 private:
  const OdometryChains& chains_;
  const PoseVolume volume_;
  const double threshold_;
};

}  // namespace

void ChanceAgreementOptions::visit(OptionVisitor& v) {
  v("max_chance", max_chance, "",
    "loop closures stay out if a false one agrees with odometry and its neighbours so well with "
    "this probability",
    kShare);
  v("partner_nodes", partner_nodes, "key nodes",
    "loop closures are compared if both their ends are this near", {1});
}

void ChanceAgreement::reject(const PoseGraph& graph, std::vector<bool>& admitted) {
  const OdometryChains chains(graph);
  const Chance chance(graph, chains);
  Neighbourhoods neighbourhoods(chains, options_.partner_nodes);
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
  for (const auto& [loop, by_odometry] : doubtful)
    if (by_odometry * chance.ofPartners(loop, neighbourhoods.near(loop)) > options_.max_chance)
      admitted[loop.edge] = false;
}

}  // namespace lamp
