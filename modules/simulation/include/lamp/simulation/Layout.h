#pragma once

#include <Eigen/Core>
#include <vector>

namespace lamp::simulation {

/** A way between two places that a robot can drive. */
struct Passage {
  size_t from = 0, to = 0;  ///< in Layout::places
  /** Middle of the floor from one place to the other, both included. */
  std::vector<Eigen::Vector3d> floor;
  double width_m = 3;  ///< that can be driven
  double length() const;
};

/** Where robots can go: places and the passages between them. World frame, metres. */
struct Layout {
  std::vector<Eigen::Vector3d> places;
  std::vector<Passage> passages;
  size_t gate = 0;  ///< the place where all robots start
  /** Groups of spots that look alike although they are far apart. */
  std::vector<std::vector<Eigen::Vector3d>> look_alikes;

  /** Passages that begin or end at a place. */
  std::vector<size_t> passagesAt(size_t place) const;
  /** Horizontal distance from the nearest passage on the same floor (within 2 m of height). */
  double distanceToPassages(const Eigen::Vector3d& p) const;
};

}  // namespace lamp::simulation
