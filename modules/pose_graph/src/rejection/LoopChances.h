#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "rejection/LoopCycles.h"
#include "rejection/PoseVolume.h"

namespace lamp {

/** Further partners add nothing. */
constexpr size_t kMaxPartners = 30;

/** The chance that a false loop looks as good as the one at hand. */
class LoopChances {
 public:
  LoopChances(const PoseGraph& graph, const OdometryChains& chains)
      : chains_(chains), volume_(graph, chains) {}

  double ofOdometry(const DirectedLoop& loop, const RelativePose& odometry) const {
    return volume_.chance(odometry.covariance + loop.measured.covariance);
  }

  /** The least k · min(1, λ)^s over all k, of the k nearest partners: distant ones, about which
   * odometry knows little, must not drown out the near ones.
   * \param enough a value at or below which the search ends. */
  double ofPartners(const DirectedLoop& loop, const std::vector<DirectedLoop>& partners,
                    double enough) const {
    double expected = 0, least = 1.0;
    int agreeing = 0;
    std::vector<Matrix6d> between;  // of partners since the last that agreed; few do
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
