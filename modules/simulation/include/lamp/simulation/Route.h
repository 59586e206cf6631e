#pragma once

#include "lamp/simulation/Layout.h"
#include "lamp/simulation/Random.h"

namespace lamp::simulation {

/** A stretch that is driven forwards; between two legs the robot turns on the spot. */
struct Leg {
  struct Point {
    Eigen::Vector3d floor;
    double width_m;  ///< that can be driven here
  };
  std::vector<Point> points;
};

/** The way of each robot of a team through a layout, from the gate. Each robot prefers passages
 * that it has seen least, and to a lesser degree those that its team has seen least, so that ways
 * explore, close loops and overlap; it turns back at dead ends and, in time to use up `length_m`,
 * to the gate. */
std::vector<std::vector<Leg>> planRoutes(const Layout& layout, const std::vector<double>& length_m,
                                         uint64_t seed);

}  // namespace lamp::simulation
