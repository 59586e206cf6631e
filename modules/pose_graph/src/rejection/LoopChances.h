#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "rejection/LoopCycles.h"
#include "rejection/PoseVolume.h"

namespace lamp {

/** More partners tell nothing new. */
constexpr size_t kMaxPartners = 30;

/** The chance that what is seen of a loop is seen of a false one. */
class LoopChances {
 public:
  LoopChances(const PoseGraph& graph, const OdometryChains& chains)
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
    std::vector<Matrix6d> between;  // of nearer partners that do not agree, as most do not
    for (size_t k = 0; k < partners.size() && least > enough; ++k) {
      const Closure closure = cycle(loop, partners[k], chains_);
      between.push_back(closure.covariance);
      if (closure.distance2() > volume_.usualThreshold()) continue;
      ++agreeing;
      for (const Matrix6d& covariance : between) expected += volume_.chance(covariance);
      between.clear();
      least =
          std::min(least, static_cast<double>(k + 1) * std::pow(std::min(1.0, expected), agreeing));
    }
    return least;
  }

 private:
  const OdometryChains& chains_;
  const PoseVolume volume_;
};

}  // namespace lamp
