#include "lamp/pose_graph/OdometryGate.h"

#include <algorithm>

#include "Information.h"
#include "OdometryChains.h"
#include "PoseVolume.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/InitialGuess.h"

IMPLEMENTS_MRPT_OBJECT(OdometryGate, OutlierRejection, lamp)

namespace lamp {

namespace {

/** A share of true loops that any map can be expected to have. */
constexpr double kLeastShare = 0.1;
/** Smaller scales may be chance, and do no harm. */
constexpr double kLeastMistake = 4.0;
constexpr double kMuchMore = 3.0;

/** A loop closure beside what odometry says. */
struct GatedLoop {
  EdgeIndex edge;
  Vector6d error;
  Matrix6d odometry_covariance, loop_covariance;  ///< both in the tangent space of the error
  int rank;

  double distance2(double scale) const {
    return mahalanobis2(error, scale * odometry_covariance + loop_covariance);
  }
};

std::vector<GatedLoop> gatedLoops(const PoseGraph& graph, const std::vector<bool>& admitted) {
  const OdometryChains chains(graph);
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

/** How many loops lie as near to odometry as half of all true ones should. */
double countNear(const std::vector<GatedLoop>& loops, double scale) {
  return static_cast<double>(std::count_if(loops.begin(), loops.end(), [&](const GatedLoop& loop) {
    return loop.distance2(scale) <= chiSquareQuantile(0.5, loop.rank);
  }));
}

/** The least scale, at least 1, with which a tenth of the loops lies as near as half of all true
 * loops should: where one loop in five is true, those are the better half of them. */
double odometryScale(const std::vector<GatedLoop>& loops, double max_scale) {
  const double wanted = kLeastShare * static_cast<double>(loops.size());
  double scale = 1.0;
  while (scale < max_scale && countNear(loops, scale) < wanted) scale *= 2.0;
  return std::min(scale, max_scale);
}

/** Whether more loops lie that near than false ones would by chance. */
bool isMeaningful(const std::vector<GatedLoop>& loops, double scale, const PoseVolume& volume) {
  double by_chance = 0;
  for (const GatedLoop& loop : loops)
    by_chance += volume.chance(scale * loop.odometry_covariance + loop.loop_covariance,
                               chiSquareQuantile(0.5, loop.rank));
  return countNear(loops, scale) >= kMuchMore * (1.0 + by_chance);
}

}  // namespace

void OdometryGateOptions::visit(OptionVisitor& v) {
  v("inlier_probability", inlier_probability, "", "share of true loop closures that are to pass",
    {0.0, 1.0 - 1e-12});
  v("max_scale", max_scale, "",
    "how many times larger than stated the covariances of odometry may be taken", {1.0});
}

void OdometryGate::reject(const PoseGraph& graph, std::vector<bool>& admitted) {
  const std::vector<GatedLoop> loops = gatedLoops(graph, admitted);
  const double scale = odometryScale(loops, options_.max_scale);
  scale_ = 1.0;
  if (scale >= kLeastMistake &&
      isMeaningful(loops, scale, PoseVolume(initialGuess(graph), graph.planar())))
    scale_ = scale;
  for (const GatedLoop& loop : loops)
    if (loop.distance2(scale) > chiSquareQuantile(options_.inlier_probability, loop.rank))
      admitted[loop.edge] = false;
}

}  // namespace lamp
