#include "BoxWorld.h"

#include <algorithm>
#include <limits>
#include <random>

namespace lamp::test {

namespace {

constexpr double kLength = 20, kWidth = 15, kHeight = 3, kThickness = 0.2;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/** Distance at which the ray enters the box; infinity if it does not. */
double entry(const Box& box, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  double near = 0, far = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < box.min[axis] || origin[axis] > box.max[axis]) return kInfinity;
      continue;
    }
    const double a = (box.min[axis] - origin[axis]) / direction[axis];
    const double b = (box.max[axis] - origin[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far ? near : kInfinity;
}

double distanceToBoundary(const Box& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d outside = (box.min - point).cwiseMax(point - box.max);
  return outside.maxCoeff() > 0 ? outside.cwiseMax(0).norm() : -outside.maxCoeff();
}

/** Builds in the coordinates of the building. */
class Builder {
 public:
  Builder(BoxWorld& world, const Eigen::Vector2d& origin)
      : world_(world), origin_(origin.x(), origin.y(), 0) {}

  void box(double x0, double y0, double x1, double y1, double z0 = 0, double z1 = kHeight) {
    world_.add({origin_ + Eigen::Vector3d(x0, y0, z0), origin_ + Eigen::Vector3d(x1, y1, z1)});
  }

  void shell() {
    box(0, 0, kLength, kWidth, -kThickness, 0);
    box(0, 0, kLength, kWidth, kHeight, kHeight + kThickness);
    box(-kThickness, -kThickness, 0, kWidth + kThickness);
    box(kLength, -kThickness, kLength + kThickness, kWidth + kThickness);
    box(-kThickness, -kThickness, kLength + kThickness, 0);
    box(-kThickness, kWidth, kLength + kThickness, kWidth + kThickness);
  }

  void rooms() {
    box(6, 5.5, 8, 5.7);
    box(9.5, 5.5, 14, 5.7);
    box(6, 9.3, 11.5, 9.5);
    box(12.7, 9.3, 14, 9.5);
    box(6, 5.5, 6.2, 9.5);
    box(13.8, 5.5, 14, 9.5);
    box(9.9, 5.5, 10.1, 9.5);
  }

  /** Cupboards along the outer walls and pillars, each of its own size. */
  void furniture(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&](double min, double max) {
      return std::uniform_real_distribution<double>(min, max)(random);
    };
    for (const double y : {0.0, kWidth})
      for (double x = 1; x < kLength - 1; x += uniform(2.5, 4.5)) {
        const double depth = uniform(0.3, 1.2);
        box(x, y > 0 ? y - depth : 0, x + uniform(0.4, 1.4), y > 0 ? y : depth, 0, uniform(0.5, 2));
      }
    for (const double x : {0.0, kLength})
      for (double y = 2; y < kWidth - 2; y += uniform(2, 4)) {
        const double depth = uniform(0.3, 1.2);
        box(x > 0 ? x - depth : 0, y, x > 0 ? x : depth, y + uniform(0.4, 1.2), 0, uniform(0.5, 2));
      }
    for (const double x : {4.4, 15.3}) {
      const double y = uniform(5, 10);
      box(x, y, x + 0.4, y + 0.4);
    }
  }

 private:
  BoxWorld& world_;
  const Eigen::Vector3d origin_;
};

}  // namespace

BoxWorld BoxWorld::building(unsigned seed, const Eigen::Vector2d& origin) {
  BoxWorld world;
  Builder builder(world, origin);
  builder.shell();
  builder.rooms();
  builder.furniture(seed);
  return world;
}

double BoxWorld::range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  double nearest = kInfinity;
  for (const Box& box : boxes_) nearest = std::min(nearest, entry(box, origin, direction));
  return nearest;
}

bool BoxWorld::isInside(const Eigen::Vector3d& point) const {
  return std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& box) {
    return (box.min - point).cwiseMax(point - box.max).maxCoeff() < 0;
  });
}

double BoxWorld::distanceToSurface(const Eigen::Vector3d& point) const {
  double nearest = kInfinity;
  for (const Box& box : boxes_) nearest = std::min(nearest, distanceToBoundary(box, point));
  return nearest;
}

}  // namespace lamp::test
