#include "MoversNear.h"

namespace lamp::simulation {

MoversNear::MoversNear(const std::vector<Mover>& movers, const Eigen::Vector3d& sensor,
                       double reach_m, double begin_stamp, double duration_s) {
  constexpr double kMarginM = 5;  // its size, and how far it moves in a sweep
  for (const Mover& mover : movers) {
    const TrajectoryInterpolator& way = mover.world_T_mover;
    if ((way.at(begin_stamp).translation() - sensor).norm() > reach_m + kMarginM) continue;
    near_.push_back(
        {&mover, SensorPath([&](double stamp) { return way.at(stamp); }, begin_stamp, duration_s)});
  }
}

void MoversNear::moveTo(double delay) {
  for (Near& near : near_) near.mover_T_world = near.path.at(delay).inverse();
}

std::optional<MoversNear::Hit> MoversNear::cast(const Eigen::Vector3f& origin,
                                                const Eigen::Vector3f& direction,
                                                float max_range_m) const {
  std::optional<Hit> nearest;
  for (const Near& near : near_) {
    const Eigen::Vector3f ray = near.mover_T_world.linear() * direction;
    const auto hit = near.mover->cast(near.mover_T_world * origin, ray);
    if (!hit || hit->range_m > (nearest ? nearest->range_m : max_range_m)) continue;
    nearest = {hit->range_m, std::abs(hit->normal.dot(ray)), near.mover->material};
  }
  return nearest;
}

}  // namespace lamp::simulation
