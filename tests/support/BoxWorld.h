#pragma once

#include <Eigen/Core>
#include <vector>

namespace lamp::test {

/** A box with sides along the axes of the world, in metres. */
struct Box {
  Eigen::Vector3d min, max;
};

/** A world of boxes, whose surfaces are known exactly. */
class BoxWorld {
 public:
  /** One storey of 20 x 15 x 3 m: a corridor, 3 m wide and more, around two inner rooms with doors,
   * and furniture that differs with the seed. The lower left corner is at `origin`, the floor at
   * z = 0. The rectangle from (3, 3) to (17, 12) is free to drive on. */
  static BoxWorld building(unsigned seed, const Eigen::Vector2d& origin = Eigen::Vector2d::Zero());

  void add(const Box& box) { boxes_.push_back(box); }
  /** Distance along the unit vector `direction` to the first surface; infinity if there is none. */
  double range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  bool isInside(const Eigen::Vector3d& point) const;
  /** Distance to the nearest surface, from outside or from inside a box. */
  double distanceToSurface(const Eigen::Vector3d& point) const;

 private:
  std::vector<Box> boxes_;
};

}  // namespace lamp::test
