#include "lamp/simulation/Drive.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "lamp/simulation/Noise.h"

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

constexpr double kSpacingM = 0.1, kStepS = 0.05;
constexpr double kSmoothM = 1.2, kWanderWavelengthM = 12.0, kSwayWavelengthM = 2.5;
/** At a radius of 1 m the robot drives at half its speed. */
constexpr double kSlowingM = 1.0;

/** Points every `kSpacingM` along a leg, with the width at each. */
std::vector<Leg::Point> resample(const Leg& leg) {
  std::vector<Leg::Point> points;
  for (size_t i = 1; i < leg.points.size(); ++i) {
    const Leg::Point &a = leg.points[i - 1], &b = leg.points[i];
    const double length = (b.floor - a.floor).norm();
    const int count = std::max(1, static_cast<int>(std::round(length / kSpacingM)));
    for (int k = 0; k < count; ++k)
      points.push_back({a.floor + (b.floor - a.floor) * k / count, b.width_m});
  }
  if (!leg.points.empty()) points.push_back(leg.points.back());
  return points;
}

/** Three passes of a moving mean, which come near a Gaussian; the ends stay. */
void smooth(std::vector<Vector3d>& line, double reach_m) {
  const auto reach = static_cast<int>(reach_m / kSpacingM);
  const auto size = static_cast<int>(line.size());
  for (int pass = 0; pass < 3; ++pass) {
    std::vector<Vector3d> sums(line.size() + 1, Vector3d::Zero());
    for (size_t i = 0; i < line.size(); ++i) sums[i + 1] = sums[i] + line[i];
    for (int i = 0; i < size; ++i) {
      const int r = std::min({reach, i, size - 1 - i});
      line[static_cast<size_t>(i)] =
          (sums[static_cast<size_t>(i + r + 1)] - sums[static_cast<size_t>(i - r)]) / (2 * r + 1);
    }
  }
}

/** Puts the line onto the floor, as smooth as wheels as far apart as a robot's make it. */
void lowerToFloor(std::vector<Vector3d>& line, const RayCaster& world) {
  constexpr double kAboveM = 1.2, kWheelbaseM = 0.5;
  constexpr float kDeepestM = 4.0f;
  for (Vector3d& point : line) {
    const Vector3d above = point + Vector3d(0, 0, kAboveM);
    const auto hit = world.cast(above.cast<float>(), {0, 0, -1}, kDeepestM);
    if (hit) point.z() = above.z() - hit->range_m;
  }
  smooth(line, kWheelbaseM);
}

/** The driven line of a leg: off the middle by up to a fifth of the width. */
std::vector<Vector3d> drivenLine(const Leg& leg, double wander_m, const Noise& noise, double lane,
                                 const RayCaster& world) {
  const std::vector<Leg::Point> points = resample(leg);
  std::vector<Vector3d> line;
  for (size_t i = 0; i < points.size(); ++i) {
    const size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, points.size() - 1);
    const Vector3d along = points[after].floor - points[before].floor;
    const Vector3d left = Vector3d(-along.y(), along.x(), 0).normalized();
    const double limit = std::min(wander_m, 0.2 * points[i].width_m);
    const double at = static_cast<double>(i) * kSpacingM;
    // Ends are shared with the next leg: the offset fades there.
    const double to_end = kSpacingM * static_cast<double>(std::min(i, points.size() - 1 - i));
    const double fade = std::min(1.0, to_end / 3.0);
    const double offset =
        std::clamp(2.0 * noise.at({at, lane, 0.5}, kWanderWavelengthM), -1.0, 1.0);
    line.push_back(points[i].floor + fade * limit * offset * left);
  }
  smooth(line, kSmoothM);
  lowerToFloor(line, world);
  return line;
}

double yawAlong(const std::vector<Vector3d>& line, size_t i) {
  const size_t reach = 3;
  const Vector3d along =
      line[std::min(i + reach, line.size() - 1)] - line[i > reach ? i - reach : 0];
  return std::atan2(along.y(), along.x());
}

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * M_PI);
}

/** Builds the poses one after the other. */
class Driver {
 public:
  Driver(const DriveOptions& options, double start_stamp, uint64_t seed)
      : options_(options),
        noise_(mixSeeds({seed, 1})),
        random_(mixSeeds({seed, 2})),
        stamp_(start_stamp),
        next_halt_m_(options.halt_every_m) {}

  void drive(const Leg& leg, double lane, const RayCaster& world) {
    const std::vector<Vector3d> line = drivenLine(leg, options_.wander_m, noise_, lane, world);
    if (line.size() < 2) return;
    turnTo(yawAlong(line, 0), slopeAlong(line, 0), line.front());
    double at = 0;  // place on the line, in points
    while (at + 1 < static_cast<double>(line.size())) {
      const auto i = static_cast<size_t>(at);
      const double share = at - static_cast<double>(i);
      const double yaw_here = yawAlong(line, i), yaw_next = yawAlong(line, i + 1);
      const double turn = wrapped(yaw_next - yaw_here);
      floor_ = line[i] + share * (line[i + 1] - line[i]);
      yaw_ = yaw_here + share * turn;
      slope_ = slopeAlong(line, i);
      if (poses_.empty()) stand();
      push();
      const double spacing = std::max((line[i + 1] - line[i]).norm(), 1e-3);
      const double curvature = std::abs(turn) / spacing;
      const double step = kStepS * options_.speed_mps / (1.0 + kSlowingM * curvature);
      at += step / spacing;
      length_m_ += step;
      if (options_.halt_s > 0 && length_m_ >= next_halt_m_) halt();
    }
  }

  std::vector<StampedPose> take() { return std::move(poses_); }

 private:
  static double slopeAlong(const std::vector<Vector3d>& line, size_t i) {
    const size_t reach = 4;
    const Vector3d along =
        line[std::min(i + reach, line.size() - 1)] - line[i > reach ? i - reach : 0];
    return std::atan2(along.z(), along.head<2>().norm());
  }

  /** On the spot. What was uphill becomes downhill, so the slope turns as well. */
  void turnTo(double yaw, double slope, const Vector3d& floor) {
    floor_ = floor;
    if (poses_.empty()) yaw_ = yaw;
    const double step = kStepS * options_.turn_rate_dps * M_PI / 180.0;
    const double slope_before = slope_, turn = std::abs(wrapped(yaw - yaw_));
    while (std::abs(wrapped(yaw - yaw_)) > step) {
      yaw_ += std::copysign(step, wrapped(yaw - yaw_));
      slope_ = slope + (slope_before - slope) * std::abs(wrapped(yaw - yaw_)) / turn;
      push();
    }
  }

  /** Where it is, before it sets off. */
  void stand() {
    const double until = stamp_ + options_.stand_s;
    while (stamp_ + kStepS < until) push();
  }

  void halt() {
    next_halt_m_ += options_.halt_every_m * uniform(random_, 0.5, 1.5);
    const double until = stamp_ + options_.halt_s * uniform(random_, 0.5, 1.5);
    while (stamp_ < until) push();
  }

  /** The pose here and now, swaying with the ground; it sways with the place, not with time. */
  void push() {
    const double d = options_.sway_deg * M_PI / 180.0;
    const auto sway = [&](double channel) {
      const Vector3d place(floor_.x(), floor_.y(), floor_.z() + channel);
      return 2.0 * noise_.at(place, kSwayWavelengthM);
    };
    Vector6d pose;
    pose << floor_, yaw_, -slope_ + d * sway(101), d * sway(202);
    pose.z() += options_.sway_m * sway(303);
    poses_.push_back({stamp_, poseFromYawPitchRoll(pose)});
    stamp_ += kStepS;
  }

  const DriveOptions& options_;
  const Noise noise_;
  Random random_;
  double stamp_;
  double length_m_ = 0;
  double next_halt_m_;
  Vector3d floor_ = Vector3d::Zero();
  double yaw_ = 0, slope_ = 0;
  std::vector<StampedPose> poses_;
};

}  // namespace

void DriveOptions::visit(OptionVisitor& v) {
  v("speed_mps", speed_mps, "m/s", "speed on a straight way", {0.05, 20});
  v("turn_rate_dps", turn_rate_dps, "deg/s", "how fast the robot turns on the spot", {1, 360});
  v("wander_m", wander_m, "m", "how far the robot strays from the middle of the way, at most",
    kNotNegative);
  v("sway_m", sway_m, "m", "height of the bumps that the robot drives over", kNotNegative);
  v("sway_deg", sway_deg, "deg", "roll and pitch that they cause", kNotNegative);
  v("halt_every_m", halt_every_m, "m", "the robot halts about this often", kPositive);
  v("halt_s", halt_s, "s", "for about so long; 0 for never", kNotNegative);
  v("stand_s", stand_s, "s", "time that the robot stands before it sets off", kNotNegative);
}

std::vector<StampedPose> drive(const std::vector<Leg>& route, const RayCaster& world,
                               const DriveOptions& options, double start_stamp, uint64_t seed) {
  Driver driver(options, start_stamp, seed);
  for (size_t i = 0; i < route.size(); ++i)
    driver.drive(route[i], 1000.0 * static_cast<double>(i), world);
  std::vector<StampedPose> poses = driver.take();
  if (poses.empty()) throw std::logic_error("drive: the route has no length");
  return poses;
}

}  // namespace lamp::simulation
