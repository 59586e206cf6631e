#include "lamp/simulation/Movers.h"

#include <algorithm>
#include <cmath>

#include "lamp/simulation/Random.h"

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

const Eigen::Vector3f kPersonSize(0.35f, 0.5f, 1.75f), kVehicleSize(2.2f, 1.2f, 1.6f);

/** Points along a line, no farther apart than `spacing_m`, its ends among them. */
std::vector<Vector3d> densified(const std::vector<Vector3d>& line, double spacing_m) {
  std::vector<Vector3d> points;
  for (size_t i = 1; i < line.size(); ++i) {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((line[i] - line[i - 1]).norm() / spacing_m)));
    for (int k = 0; k < steps; ++k)
      points.push_back(line[i - 1] + (line[i] - line[i - 1]) * k / steps);
  }
  if (!line.empty()) points.push_back(line.back());
  return points;
}

/** The floor below a point. */
Vector3d onFloor(const Vector3d& point, const RayCaster& world) {
  constexpr double kAboveM = 1.2;
  constexpr float kDeepestM = 4.0f;
  const Vector3d above = point + Vector3d(0, 0, kAboveM);
  const auto hit = world.cast(above.cast<float>(), {0, 0, -1}, kDeepestM);
  return hit ? Vector3d(above - Vector3d(0, 0, hit->range_m)) : point;
}

/** One mover's way through the passages. */
class Wanderer {
 public:
  Wanderer(const Layout& layout, const RayCaster& world, double half_width_m, double speed_mps,
           uint64_t seed)
      : layout_(layout),
        world_(world),
        half_width_m_(half_width_m),
        speed_mps_(speed_mps),
        random_(seed) {}

  std::vector<StampedPose> wander(const MoverOptions& options, const TimeSpan& time) {
    stamp_ = time.begin;
    size_t place = layout_.passages[pick(random_, layout_.passages.size())].from;
    while (stamp_ < time.end) {
      const std::vector<size_t> choice = layout_.passagesAt(place);
      const Passage& passage = layout_.passages[choice[pick(random_, choice.size())]];
      const bool forwards = passage.from == place;
      walk(laneOf(passage, forwards));
      place = forwards ? passage.to : passage.from;
      if (chance(random_, options.stop_share)) stop(options.stop_s * uniform(random_, 0.5, 1.5));
    }
    return std::move(poses_);
  }

 private:
  /** On the right, with some room to the wall. */
  std::vector<Vector3d> laneOf(const Passage& passage, bool forwards) const {
    constexpr double kSpacingM = 0.5, kRoomM = 0.4;
    std::vector<Vector3d> middle = densified(passage.floor, kSpacingM), lane;
    if (!forwards) std::reverse(middle.begin(), middle.end());
    const double aside = std::max(0.0, passage.width_m / 2 - half_width_m_ - kRoomM);
    for (size_t i = 0; i < middle.size(); ++i) {
      const Vector3d along = middle[std::min(i + 1, middle.size() - 1)] - middle[i > 0 ? i - 1 : i];
      const Vector3d right = Vector3d(along.y(), -along.x(), 0).normalized();
      lane.push_back(onFloor(middle[i] + aside * right, world_));
    }
    return lane;
  }

  void walk(const std::vector<Vector3d>& lane) {
    for (const Vector3d& point : lane) {
      if (poses_.empty()) {
        push(point, 0);
        continue;
      }
      const Vector3d way = point - poses_.back().pose.translation();
      if (way.norm() < 1e-3) continue;
      stamp_ += way.norm() / speed_mps_;
      push(point, std::atan2(way.y(), way.x()));
    }
  }
  void stop(double seconds) {
    StampedPose pose = poses_.back();
    pose.stamp = stamp_ += seconds;
    poses_.push_back(pose);
  }
  void push(const Vector3d& foot, double yaw) {
    Vector6d pose;
    pose << foot, yaw, 0, 0;
    poses_.push_back({stamp_, poseFromYawPitchRoll(pose)});
  }

  const Layout& layout_;
  const RayCaster& world_;
  const double half_width_m_, speed_mps_;
  Random random_;
  double stamp_ = 0;
  std::vector<StampedPose> poses_;
};

}  // namespace

std::optional<Mover::Hit> Mover::cast(const Eigen::Vector3f& origin,
                                      const Eigen::Vector3f& direction) const {
  const Eigen::Vector3f low(-0.5f * size.x(), -0.5f * size.y(), 0),
      high(0.5f * size.x(), 0.5f * size.y(), size.z());
  float enter = 0, leave = std::numeric_limits<float>::infinity();
  int face = -1;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < low[axis] || origin[axis] > high[axis]) return std::nullopt;
      continue;
    }
    float in = (low[axis] - origin[axis]) / direction[axis],
          out = (high[axis] - origin[axis]) / direction[axis];
    if (in > out) std::swap(in, out);
    if (in > enter) face = axis;
    enter = std::max(enter, in);
    leave = std::min(leave, out);
  }
  if (face < 0 || enter > leave) return std::nullopt;
  Hit hit{enter, Eigen::Vector3f::Zero()};
  hit.normal[face] = direction[face] > 0 ? -1.0f : 1.0f;
  return hit;
}

std::vector<Mover> makeMovers(const MoverOptions& options, const Layout& layout,
                              const RayCaster& world, const TimeSpan& time, uint64_t seed) {
  std::vector<Mover> movers;
  const auto add = [&](int count, const Eigen::Vector3f& size, Material material, double speed,
                       uint64_t kind) {
    for (int i = 0; i < count; ++i) {
      Wanderer wanderer(layout, world, 0.5 * size.y(), speed,
                        mixSeeds({seed, kind, static_cast<uint64_t>(i)}));
      movers.push_back({size, material, TrajectoryInterpolator(wanderer.wander(options, time))});
    }
  };
  add(options.people, kPersonSize, Material::kConcrete, options.person_speed_mps, 1);
  add(options.vehicles, kVehicleSize, Material::kMetal, options.vehicle_speed_mps, 2);
  return movers;
}

}  // namespace lamp::simulation
