/** How thick the walls of a map are that a robot makes while it turns fast, against one of scans
 * that were taken at rest. */
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "lamp/core/KdTree.h"
#include "lamp/frontend/FrontEnd.h"
#include "lamp/frontend/LidarOdometry.h"
#include "lamp/frontend/RecordedOdometry.h"
#include "lamp/simulation/Route.h"
#include "lamp/simulation/SensorObservations.h"
#include "lamp/simulation/SimConfig.h"
#include "lamp/simulation/VelodyneObservation.h"

namespace lamp {
namespace {

using namespace simulation;

constexpr RobotId kRobot{0};
constexpr double kBegin = 1.6e9, kScan_s = 0.1, kStanding_s = 1, kTurning_s = 6;
constexpr double kRate = 1;  ///< radians per second
/** Walls are flat within this radius where those of a robot at rest are no thicker than this. */
constexpr float kPatch_m = 0.3f, kFlat_m = 0.05f;
constexpr size_t kMostNeighbors = 200, kFewestNeighbors = 12;

using Points = std::vector<Eigen::Vector3f>;

/** Stands, then turns on the spot: evenly, or to and fro, as fast as that in the middle. */
TrajectoryInterpolator turning(const Pose3& world_T_start, bool evenly) {
  std::vector<StampedPose> poses;
  for (double t = 0; t < kStanding_s + kTurning_s; t += 0.05) {
    const double angle = kRate * std::max(0.0, t - kStanding_s);
    const double yaw = evenly ? angle : 2 * std::sin(0.5 * angle);
    poses.push_back({kBegin + t, Pose3(world_T_start * planarPose(0, 0, yaw))});
  }
  return TrajectoryInterpolator(poses);
}

TrajectoryInterpolator resting(const Pose3& pose) {
  return TrajectoryInterpolator({{kBegin, pose}, {kBegin + 100, pose}});
}

/** A robot with its lidars in a world. */
struct Site {
  explicit Site(const std::string& name, uint64_t seed)
      : config(worldKind(name), Ini(), Faults()),
        world(config.kind->make(150, config.cellM(), seed)),
        caster(world.mesh),
        robot(config.robots.front()) {
    for (const std::string& lidar : robot.lidars)
      lidars.emplace_back(config.lidars.at(lidar), caster);
    const auto route = planRoutes(world.layout, {40.0}, seed).front();
    const auto poses = drive(route, caster, robot.drive, kBegin, seed);
    place = poses[poses.size() / 3].pose;
  }

  std::vector<InputObservation> scan(const TrajectoryInterpolator& truth, double stamp) const {
    std::vector<InputObservation> result;
    for (size_t i = 0; i < lidars.size(); ++i)
      for (const auto& observation : velodyneObservations(lidars[i].sweep(truth, stamp, i),
                                                          lidars[i], "robot/" + robot.lidars[i]))
        result.push_back(
            {kRobot, robot.lidars[i], mrpt::Clock::toDouble(observation->timestamp), observation});
    return result;
  }

  SimConfig config;
  World world;
  RayCaster caster;
  SimulatedRobotOptions robot;
  std::vector<Lidar> lidars;
  Pose3 place;
};

/** All points of the key nodes, in the frame of the first. */
Points mapped(const std::vector<KeyNodePacket>& packets) {
  Points map;
  for (const KeyNodePacket& packet : packets) {
    const Eigen::Isometry3f T =
        (packets.front().odom_T_base.inverse() * packet.odom_T_base).cast<float>();
    for (const Eigen::Vector3f& point : packet.scan->points) map.push_back(T * point);
  }
  return map;
}

/** All that the robot records. \param alone without odometry and an inertial unit. */
std::vector<InputObservation> recording(const Site& site, const TrajectoryInterpolator& truth,
                                        bool alone) {
  std::vector<InputObservation> all;
  for (double t = 0; t + kScan_s < kStanding_s + kTurning_s; t += kScan_s)
    for (InputObservation& observation : site.scan(truth, kBegin + t))
      all.push_back(std::move(observation));
  if (alone) return all;
  for (const ImuReading& reading : simulateImu(truth, site.config.imu, 3))
    all.push_back({kRobot, "imu", reading.stamp, imuObservation(reading, "robot")});
  OdometryOptions options = site.robot.odometry;
  options.min_ate_m = 0;  // would be too much for a robot that stays where it is
  const SimulatedOdometry odometry = simulateOdometry(truth, options, 4);
  for (size_t i = 0; i < odometry.odom_T_base.size(); ++i)
    all.push_back(
        {kRobot, "odom", odometry.odom_T_base[i].stamp, odometryObservation(odometry, i, "robot")});
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return all;
}

std::vector<KeyNodePacket> throughFrontEnd(const std::vector<InputObservation>& recording,
                                           const FrontEndOptions& options) {
  FrontEnd front_end(kRobot, options,
                     {std::make_shared<LidarOdometry>(), std::make_shared<RecordedOdometry>()}, {});
  std::vector<KeyNodePacket> packets;
  const auto keep = [&](std::vector<KeyNodePacket> more) {
    for (KeyNodePacket& packet : more) packets.push_back(std::move(packet));
  };
  for (const InputObservation& observation : recording) keep(front_end.observe(observation));
  keep(front_end.finish());
  return packets;
}

/** What a robot would have sent of a place if it stood there. */
KeyNodePacket atRest(const Site& site, const Pose3& pose, double stamp) {
  FrontEndOptions every_scan;
  every_scan.key_node_distance_m = 0;
  std::vector<InputObservation> recording;
  for (const double t : {stamp - kScan_s, stamp})  // scans of other lidars are joined to the next
    for (InputObservation& observation : site.scan(resting(pose), t))
      recording.push_back(std::move(observation));
  KeyNodePacket packet = throughFrontEnd(recording, every_scan).at(1);
  packet.odom_T_base = pose;
  return packet;
}

/** Squared distances of the points around a place to their plane: the mean, m². */
std::optional<double> squaredThickness(const KdTree& tree, const Points& points,
                                       const Eigen::Vector3f& place) {
  std::vector<uint32_t> indices;
  tree.nearest(place, kMostNeighbors, indices);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  size_t count = 0;
  for (const uint32_t i : indices)
    if ((points[i] - place).norm() < kPatch_m) {
      mean += points[i].cast<double>();
      ++count;
    }
  if (count < kFewestNeighbors) return std::nullopt;
  mean /= static_cast<double>(count);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (size_t k = 0; k < count; ++k) {
    const Eigen::Vector3d d = points[indices[k]].cast<double>() - mean;
    covariance += d * d.transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0] /
         static_cast<double>(count);
}

/** Root mean squares of the distances to local planes, metres, at the places where the map made at
 * rest is flat. */
std::pair<double, double> thickness(const Points& map, const Points& at_rest) {
  const KdTree tree(map), tree_at_rest(at_rest);
  double sum = 0, sum_at_rest = 0;
  size_t count = 0;
  for (const Eigen::Vector3f& place : at_rest) {
    const auto resting = squaredThickness(tree_at_rest, at_rest, place);
    if (!resting || *resting > kFlat_m * kFlat_m) continue;
    const auto own = squaredThickness(tree, map, place);
    if (!own) continue;
    sum += *own;
    sum_at_rest += *resting;
    ++count;
  }
  EXPECT_GT(count, at_rest.size() / 2);
  return {std::sqrt(sum / static_cast<double>(count)),
          std::sqrt(sum_at_rest / static_cast<double>(count))};
}

struct Turn {
  std::string world;
  bool evenly, alone;
};

class TurningRobot : public testing::TestWithParam<Turn> {};

TEST_P(TurningRobot, WallsAreAsThinAsThoseOfARobotAtRest) {
  const Site site(GetParam().world, 1);
  const TrajectoryInterpolator truth = turning(site.place, GetParam().evenly);
  const auto packets = throughFrontEnd(recording(site, truth, GetParam().alone), {});
  ASSERT_GE(packets.size(), 6u);
  std::vector<KeyNodePacket> resting;
  for (const KeyNodePacket& packet : packets)
    resting.push_back(atRest(site, truth.at(packet.stamp), packet.stamp));
  const auto [own_m, at_rest_m] = thickness(mapped(packets), mapped(resting));
  std::cout << GetParam().world << ": " << 1000 * own_m << " mm, at rest " << 1000 * at_rest_m
            << " mm" << std::endl;
  EXPECT_LT(own_m, 1.3 * at_rest_m);
}

void PrintTo(const Turn& turn, std::ostream* out) {
  *out << turn.world << (turn.evenly ? ", evenly" : ", to and fro");
}

// Three lidars, whose scans are not of the same time, and the motion is to be found with the scan;
// one lidar with all that helps.
INSTANTIATE_TEST_SUITE_P(Turns, TurningRobot,
                         testing::Values(Turn{"urban", false, true}, Turn{"urban", true, true},
                                         Turn{"demo", true, false}));

}  // namespace
}  // namespace lamp
