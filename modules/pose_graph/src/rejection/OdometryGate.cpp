#include "lamp/pose_graph/OdometryGate.h"

#include <algorithm>
#include <cmath>

#include "lamp/core/ChiSquare.h"
#include "rejection/LoopChances.h"
#include "rejection/OdometryChains.h"
#include "rejection/PoseVolume.h"
#include "rejection/Witnesses.h"
#include "solver/Information.h"

IMPLEMENTS_MRPT_OBJECT(OdometryGate, OutlierRejection, lamp)

namespace lamp {

namespace {

constexpr double kNearly = 0.97;
constexpr size_t kSampled = 400;
constexpr size_t kEnoughPlaces = 20;
/** The share of false loops is a posterior mean. This is the share expected beforehand, with the
 * weight of one loop that odometry could have contradicted. */
constexpr double kPriorShare = 0.05;
constexpr double kPriorWeight = 1.0;
/** Smaller scales may be due to chance, and ignoring them does no harm. */
constexpr double kLeastMistake = 16.0;
/** A few false loops that agree must not loosen odometry: at least this many loops, and this share
 * of them, must call for it. */
constexpr double kFewestWitnesses = 10, kLeastWitnesses = 0.1;

/** A loop closure compared with odometry. */
struct GatedLoop {
  EdgeIndex edge;
  Vector6d error;
  Matrix6d odometry_covariance, loop_covariance;  ///< both in the tangent space of the error
  int rank;

  Matrix6d covariance(double scale) const { return scale * odometry_covariance + loop_covariance; }
  double distance2(double scale) const { return mahalanobis2(error, covariance(scale)); }
};

std::vector<GatedLoop> gatedLoops(const PoseGraph& graph, const OdometryChains& chains,
                                  const std::vector<bool>& admitted) {
  const bool planar = graph.planar();
  std::vector<GatedLoop> loops;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.isLoopClosure() || edge.pinned || !admitted[e]) continue;
    const auto odometry = chains.between(edge.from, edge.to);
    if (!odometry) continue;
    const Vector6d error = logSE3(edge.from_T_to.inverse() * odometry->a_T_b);
    const Matrix6d J = rightJacobianInverse(error);
    loops.push_back({e, error, J * odometry->covariance * J.transpose(),
                     boundedCovariance(edge.information, planar),
                     std::max(1, informationRank(edge.information, planar))});
  }
  return loops;
}

/** Evenly spaced loops, enough to find the scale. */
std::vector<GatedLoop> sample(const std::vector<GatedLoop>& loops) {
  const size_t step = loops.size() / kSampled + 1;
  std::vector<GatedLoop> sampled;
  for (size_t i = 0; i < loops.size(); i += step) sampled.push_back(loops[i]);
  return sampled;
}

/** The loops by which the scale is found: those that neighbours bear out, hardly any of which are
 * false, or all where such loops are few. */
std::vector<GatedLoop> scaleLoops(const PoseGraph& graph, const OdometryChains& chains,
                                  const std::vector<GatedLoop>& loops) {
  std::vector<DirectedLoop> directed_loops;
  for (const GatedLoop& loop : loops)
    directed_loops.push_back(directed(loop.edge, graph.edges()[loop.edge], graph.planar()));
  std::vector<GatedLoop> chosen;
  for (const size_t i : witnesses(directed_loops, chains, LoopChances(graph, chains)))
    chosen.push_back(loops[i]);
  return sample(chosen.size() >= kEnoughPlaces ? chosen : loops);
}

/** How many loops lie as near to odometry as true ones should, and how many would if all were
 * false. */
struct Near {
  double loops = 0, by_chance = 0;
  /** At least so many of them are true. */
  double surplus() const { return loops - by_chance - 3.0 * std::sqrt(by_chance); }
};

Near countNear(const std::vector<GatedLoop>& loops, double scale, double inlier_probability,
               const PoseVolume& volume) {
  Near near;
  for (const GatedLoop& loop : loops) {
    const double threshold = chiSquareQuantile(inlier_probability, loop.rank);
    near.loops += loop.distance2(scale) <= threshold;
    near.by_chance += volume.chance(loop.covariance(scale), threshold);
  }
  return near;
}

/** A factor on odometry's covariances, and how many more true loops lie near with it than with
 * 1. */
struct Scale {
  double value = 1.0, witnesses = 0;
};

/** The least scale, at least 1, with which nearly as many loops lie near odometry as with any
 * other, not counting those that false ones would add by chance. */
Scale fittingScale(const std::vector<GatedLoop>& loops, const OdometryGateOptions& options,
                   const PoseVolume& volume) {
  std::vector<std::pair<double, Near>> tried;
  for (double scale = 1.0;; scale *= 2.0) {
    scale = std::min(scale, options.max_scale);
    tried.emplace_back(scale, countNear(loops, scale, options.inlier_probability, volume));
    const bool all = tried.back().second.loops == static_cast<double>(loops.size());
    if (all || scale == options.max_scale) break;
  }
  double most = 0;
  for (const auto& [scale, near] : tried) most = std::max(most, near.surplus());
  if (!(most > 0)) return {};
  const auto nearly_most = std::find_if(tried.begin(), tried.end(), [&](const auto& candidate) {
    return candidate.second.surplus() >= kNearly * most;
  });
  const double at_first = std::max(0.0, tried.front().second.surplus());
  return {nearly_most->first, nearly_most->second.surplus() - at_first};
}

}  // namespace

void OdometryGateOptions::visit(OptionVisitor& v) {
  v("inlier_probability", inlier_probability, "", "probability that a true loop closure passes",
    {0.0, 1.0 - 1e-12});
  v("max_scale", max_scale, "", "maximum factor by which odometry covariances may be scaled up",
    {1.0});
}

Admission OdometryGate::reject(const PoseGraph& graph, Admission before) {
  const OdometryChains chains(graph);
  const std::vector<GatedLoop> loops = gatedLoops(graph, chains, before.admitted);
  const std::vector<GatedLoop> sampled = scaleLoops(graph, chains, loops);
  const PoseVolume volume(graph, chains);
  const Scale scale = fittingScale(sampled, options_, volume);
  const bool sure =
      scale.witnesses >=
      std::max(kFewestWitnesses, kLeastWitnesses * static_cast<double>(sampled.size()));
  if (sure && scale.value >= kLeastMistake)
    before.odometry_scale = std::max(before.odometry_scale, scale.value);
  double wrong = 0, power = 0;  // loops contradicted, and how many would be if all were false
  for (const GatedLoop& loop : loops) {
    const double threshold = chiSquareQuantile(options_.inlier_probability, loop.rank);
    power += 1.0 - volume.chance(loop.covariance(scale.value), threshold);
    if (loop.distance2(scale.value) <= threshold) continue;
    before.admitted[loop.edge] = false;
    before.waiting[loop.edge] = scale.value > 1.0;  // odometry that errs is not a safe judge
    wrong += 1.0;
  }
  if (loops.empty()) return before;
  const double share = (wrong + kPriorShare * kPriorWeight) / (power + kPriorWeight);
  before.false_loops = share * static_cast<double>(loops.size());
  return before;
}

}  // namespace lamp
