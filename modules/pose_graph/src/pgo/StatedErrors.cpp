#include "pgo/StatedErrors.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lamp/core/ChiSquare.h"
#include "lamp/core/Median.h"
#include "rejection/OdometryChains.h"
#include "rejection/PoseVolume.h"
#include "solver/Information.h"

namespace lamp {

namespace {

constexpr size_t kFewestCycles = 10, kMaxCycles = 400;
/** Factors on the stated variances. */
constexpr double kLeastFactor = 1e-12, kFarTooLarge = 1.0 / 16;
/** The share of true loop closures that counts as near, and the share of the most that counts as
 * nearly as many. */
constexpr double kNear = 0.9, kNearly = 0.97;

/** A loop closure and the odometry between its ends. */
struct OdometryCycle {
  double distance2;  ///< squared Mahalanobis distance
  Matrix6d covariance;
};

std::vector<OdometryCycle> odometryCycles(const PoseGraph& graph, const OdometryChains& chains) {
  std::vector<const Edge*> loops;
  for (const Edge& edge : graph.edges())
    if (edge.isLoopClosure() && chains.chain(edge.from) == chains.chain(edge.to))
      loops.push_back(&edge);
  std::vector<OdometryCycle> cycles;
  for (size_t i = 0; i < loops.size(); i += loops.size() / kMaxCycles + 1) {
    const RelativePose odometry = *chains.between(loops[i]->from, loops[i]->to);
    const Matrix6d covariance =
        odometry.covariance + boundedCovariance(loops[i]->information, graph.planar());
    const Vector6d error = logSE3(loops[i]->from_T_to.inverse() * odometry.a_T_b);
    cycles.push_back({mahalanobis2(error, covariance), covariance});
  }
  return cycles;
}

/** The largest squared distance at which a loop closure counts as true: near by the least factor
 * with which nearly as many are near as with any other, not counting those that false ones would
 * add by chance. Zero if there is none. */
double largestTrueDistance2(const std::vector<OdometryCycle>& cycles, const PoseVolume& volume,
                            double threshold) {
  std::vector<std::pair<double, double>> surplus;  // by factor
  double most = 0;
  for (double factor = kLeastFactor; factor <= 1.0; factor *= 2.0) {
    double near = 0, by_chance = 0;
    for (const OdometryCycle& cycle : cycles) {
      near += cycle.distance2 <= factor * threshold;
      by_chance += volume.chance(factor * cycle.covariance, threshold);
    }
    surplus.emplace_back(factor, near - by_chance - 3.0 * std::sqrt(by_chance));
    most = std::max(most, surplus.back().second);
  }
  for (const auto& [factor, count] : surplus)
    if (most > 0 && count >= kNearly * most) return factor * threshold;
  return 0;
}

}  // namespace

bool overstatesErrors(const PoseGraph& graph) {
  const OdometryChains chains(graph);
  const std::vector<OdometryCycle> cycles = odometryCycles(graph, chains);
  const int dof = graph.planar() ? 3 : 6;
  const double limit =
      largestTrueDistance2(cycles, PoseVolume(graph, chains), chiSquareQuantile(kNear, dof));
  std::vector<double> distances2;
  for (const OdometryCycle& cycle : cycles)
    if (cycle.distance2 <= limit) distances2.push_back(cycle.distance2);
  if (distances2.size() < kFewestCycles) return false;
  return medianOf(std::move(distances2)) < kFarTooLarge * chiSquareQuantile(0.5, dof);
}

}  // namespace lamp
