// How many times faster than a robot records its front end works: sweeps are undistorted and
// thinned, odometry comes from the lidar, key nodes are made. In a mine, on one core.
#include <benchmark/benchmark.h>
#include <mrpt/obs/CObservationRobotPose.h>

#include <map>
#include <memory>
#include <random>

#include "lamp/core/Trajectory.h"
#include "lamp/frontend/FrontEnd.h"
#include "lamp/frontend/LidarOdometry.h"
#include "lamp/frontend/RecordedOdometry.h"
#include "lamp/observations/CObservationTimedPoints.h"
#include "lamp/simulation/Drive.h"
#include "lamp/simulation/World.h"

namespace lamp {
namespace {

using simulation::DriveOptions;
using simulation::RayCaster;

constexpr double kSweepS = 0.1;
constexpr int kSweeps = 60;

/** A spinning lidar. */
struct LidarKind {
  int beams, columns;
  double lowest_deg, highest_deg;
};

/** A drive through a mine as one lidar sees it, with odometry as exact as wheels and gyro are over
 * some seconds. */
class Recording {
 public:
  explicit Recording(const LidarKind& lidar)
      : world_(kind().make(300, kind().cell_m, 1)),
        caster_(world_.mesh),
        truth_(drive(simulation::planRoutes(world_.layout, {100}, 1)[0], caster_, DriveOptions(), 0,
                     1)) {
    for (int i = 0; i < kSweeps; ++i) {
      const double stamp = truth_.begin() + 20 + kSweepS * i;
      for (int k = 0; k < 5; ++k) observations_.push_back(odometry(stamp + kSweepS / 5 * k));
      observations_.push_back(sweep(lidar, stamp));
    }
    for (int k = 0; k < 15; ++k)
      observations_.push_back(odometry(truth_.begin() + 20 + kSweepS * (kSweeps + 0.2 * k)));
  }

  const std::vector<InputObservation>& observations() const { return observations_; }
  double pointsPerSweep() const { return static_cast<double>(points_) / kSweeps; }

 private:
  static const simulation::WorldKind& kind() { return simulation::worldKind("tunnel"); }

  static InputObservation wrapped(const std::string& label, double stamp,
                                  const mrpt::obs::CObservation::Ptr& observation) {
    observation->timestamp = mrpt::Clock::fromDouble(stamp);
    observation->sensorLabel = label;
    return {RobotId{0}, label, stamp, observation};
  }

  InputObservation odometry(double stamp) const {
    const Vector6d pose = yawPitchRollFromPose(truth_.at(stamp));
    auto observation = mrpt::obs::CObservationRobotPose::Create();
    observation->pose.mean =
        mrpt::poses::CPose3D(pose[0], pose[1], pose[2], pose[3], pose[4], pose[5]);
    return wrapped("odom", stamp, observation);
  }

  InputObservation sweep(const LidarKind& lidar, double stamp) {
    std::normal_distribution<float> noise(0, 0.02f);
    auto observation = std::make_shared<CObservationTimedPoints>();
    observation->sensorPose = mrpt::poses::CPose3D(0, 0, 0.8, 0, 0, 0);
    observation->reserve(static_cast<size_t>(lidar.beams * lidar.columns));
    for (int column = 0; column < lidar.columns; ++column) {
      const double time = kSweepS * column / lidar.columns;
      const Pose3 world_T_lidar = truth_.at(stamp + time) * Pose3(Eigen::Translation3d(0, 0, 0.8));
      const double azimuth = -2 * M_PI * column / lidar.columns;
      for (int beam = 0; beam < lidar.beams; ++beam) {
        const double elevation =
            (lidar.lowest_deg + (lidar.highest_deg - lidar.lowest_deg) * beam / (lidar.beams - 1)) *
            M_PI / 180;
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const auto hit = caster_.cast(world_T_lidar.translation().cast<float>(),
                                      (world_T_lidar.linear() * ray).cast<float>(), 100);
        if (!hit) continue;
        const Eigen::Vector3f point = (hit->range_m + noise(random_)) * ray.cast<float>();
        observation->x.push_back(point.x());
        observation->y.push_back(point.y());
        observation->z.push_back(point.z());
        observation->time.push_back(static_cast<float>(time));
      }
    }
    points_ += observation->size();
    return wrapped("lidar", stamp, observation);
  }

  const simulation::World world_;
  const RayCaster caster_;
  const TrajectoryInterpolator truth_;
  std::mt19937 random_{1};
  size_t points_ = 0;
  std::vector<InputObservation> observations_;
};

const Recording& recordingOf(int beams) {
  static const std::map<int, LidarKind> kinds = {{16, {16, 1800, -15, 15}},
                                                 {64, {64, 2048, -22.5, 22.5}}};
  static std::map<int, std::unique_ptr<Recording>> made;
  auto& found = made[beams];
  if (!found) found = std::make_unique<Recording>(kinds.at(beams));
  return *found;
}

void frontEnd(benchmark::State& state, int beams, bool with_recorded) {
  const Recording& recording = recordingOf(beams);
  size_t key_nodes = 0, tracked = 0;
  for (auto _ : state) {
    std::vector<std::shared_ptr<OdometrySource>> sources{std::make_shared<LidarOdometry>()};
    if (with_recorded) sources.push_back(std::make_shared<RecordedOdometry>());
    FrontEnd front_end({0}, FrontEndOptions(), sources, std::nullopt);
    for (const InputObservation& observation : recording.observations())
      front_end.observe(observation);
    front_end.finish();
    key_nodes = front_end.counts().key_nodes;
    tracked = front_end.counts().tracked_scans;
  }
  using benchmark::Counter;
  state.counters["points"] = recording.pointsPerSweep();
  state.counters["key_nodes"] = static_cast<double>(key_nodes);
  state.counters["tracked"] = static_cast<double>(tracked);
  state.counters["s_per_scan"] =
      Counter(kSweeps, Counter::kIsIterationInvariantRate | Counter::kInvert);
  state.counters["times_real_time"] =
      Counter(kSweeps * kSweepS, Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(frontEnd, beams_16_alone, 16, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frontEnd, beams_16_and_recorded, 16, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frontEnd, beams_64_alone, 64, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(frontEnd, beams_64_and_recorded, 64, true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamp
