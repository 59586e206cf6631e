#pragma once

#include <Eigen/Core>
#include <array>
#include <map>
#include <vector>

namespace lamp {

/** What the points of a cloud hide from one place: the range of the nearest one in each direction.
 */
class NearestRanges {
 public:
  NearestRanges(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& viewpoint);
  /** Whether the point lies far behind another one. */
  bool hides(const Eigen::Vector3f& point) const;

 private:
  using Direction = std::array<int, 3>;
  static Direction directionOf(const Eigen::Vector3f& ray);

  Eigen::Vector3f viewpoint_;
  std::map<Direction, float> nearest_;
};

/** Places in a map where a robot may have stood: above what looks like a floor with free space over
 * it, in the middle of passages rather than at their sides, at least `spacing_m` apart.
 * \param height_m of the sensor above the floor; z is up.
 * \param max how many places at most. The same points give the same places. */
std::vector<Eigen::Vector3f> standpoints(const std::vector<Eigen::Vector3f>& map, float height_m,
                                         float spacing_m, size_t max);

/** The points of a map that a lidar would see from a place, up to a range (metres). */
std::vector<Eigen::Vector3f> visibleFrom(const Eigen::Vector3f& viewpoint,
                                         const std::vector<Eigen::Vector3f>& map, float range_m);

}  // namespace lamp
