#pragma once

#include <stdexcept>
#include <vector>

#include "lamp/core/Trajectory.h"

namespace lamp::simulation {

/** `begin`, then one stamp every `1/rate_hz` seconds up to the end of a trajectory.
 * \throws std::runtime_error unless the rate is positive. */
inline std::vector<double> sampleStamps(const TrajectoryInterpolator& trajectory, double rate_hz) {
  if (!(rate_hz > 0)) throw std::runtime_error("a sensor's rate_hz must be positive");
  constexpr double kSlack = 1e-6;  // the end counts in spite of rounding
  const auto count =
      static_cast<size_t>((trajectory.end() - trajectory.begin()) * rate_hz + kSlack);
  std::vector<double> stamps;
  stamps.reserve(count + 1);
  for (size_t i = 0; i <= count; ++i)
    stamps.push_back(trajectory.begin() + static_cast<double>(i) / rate_hz);
  return stamps;
}

}  // namespace lamp::simulation
