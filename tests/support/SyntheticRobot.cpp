#include "SyntheticRobot.h"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <random>

namespace lamp::test {

namespace {

constexpr double kStep = 0.2, kTurnStep = 15.0 * M_PI / 180.0, kSecondsPerStep = 0.2;
constexpr int kStepsPerScan = 2;
constexpr double kRangeNoise = 0.01, kLidarHeight = 0.3, kBaseHeight = 0.6;
constexpr double kOdometryNoise = 0.002;  ///< per step, metres and radians
constexpr int kRows = 16, kColumns = 150, kRays = 360;
constexpr double kLowest = -0.5, kHighest = 0.5, kMaxRange = 40;

using Noise = std::function<double(double)>;

Noise gaussian(unsigned seed) {
  return [random = std::mt19937(seed)](double sigma) mutable {
    return std::normal_distribution<double>(0, sigma)(random);
  };
}

/** Poses in the plane, a step or a small turn apart. */
std::vector<Pose3> drive(const std::vector<Eigen::Vector2d>& route) {
  std::vector<Pose3> poses;
  double heading = 0;
  for (size_t i = 1; i < route.size(); ++i) {
    const Eigen::Vector2d way = route[i] - route[i - 1];
    const double wanted = std::atan2(way.y(), way.x());
    const double turn = poses.empty() ? 0 : std::remainder(wanted - heading, 2 * M_PI);
    const int turns = static_cast<int>(std::ceil(std::abs(turn) / kTurnStep));
    for (int k = 1; k < turns; ++k)
      poses.push_back(planarPose(route[i - 1].x(), route[i - 1].y(), heading + turn * k / turns));
    heading = wanted;
    const int steps = static_cast<int>(std::ceil(way.norm() / kStep));
    for (int k = poses.empty() ? 0 : 1; k <= steps; ++k) {
      const Eigen::Vector2d at = route[i - 1] + way * k / steps;
      poses.push_back(planarPose(at.x(), at.y(), heading));
    }
  }
  return poses;
}

/** A body on springs: small, smooth motions in z, roll and pitch. */
std::vector<Pose3> sway(std::vector<Pose3> poses) {
  for (size_t i = 0; i < poses.size(); ++i) {
    const double phase = 0.3 * static_cast<double>(i);
    Vector6d motion;
    motion << 0, 0, kBaseHeight + 0.03 * std::sin(phase), 0, 0.02 * std::sin(0.7 * phase),
        0.02 * std::sin(0.9 * phase);
    poses[i] = poses[i] * poseFromYawPitchRoll(motion);
  }
  return poses;
}

/** Dead reckoning from the identity: wrong in all axes, or in the plane only. */
std::vector<Pose3> deadReckoning(const std::vector<Pose3>& truth, const SyntheticRobot& robot,
                                 bool planar, Noise& noise) {
  std::vector<Pose3> odometry = {Pose3::Identity()};
  for (size_t i = 1; i < truth.size(); ++i) {
    Vector6d motion = logSE3(truth[i - 1].inverse() * truth[i]);
    const double way = motion.head<3>().norm();
    motion.head<3>() *= 1 + robot.scale_error;
    motion[5] += robot.heading_bias_rad_per_m * way + noise(kOdometryNoise);
    for (const int axis : {0, 1}) motion[axis] += noise(kOdometryNoise);
    if (!planar)
      for (const int axis : {2, 3, 4}) motion[axis] += noise(0.2 * kOdometryNoise);
    odometry.push_back(normalized(odometry.back() * expSE3(motion)));
  }
  return planar ? [&] {
    for (Pose3& pose : odometry) pose = projectToPlane(pose);
    return odometry;
  }() : odometry;
}

mrpt::poses::CPose3D toMrpt(const Pose3& pose) {
  return mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(pose.matrix()));
}

mrpt::poses::CPose2D toMrptPlanar(const Pose3& pose) {
  return {pose.translation().x(), pose.translation().y(), yawOf(pose)};
}

template <class Observation>
std::shared_ptr<Observation> make(double stamp, const std::string& label) {
  auto observation = Observation::Create();
  observation->timestamp = mrpt::Clock::fromDouble(stamp);
  observation->sensorLabel = label;
  return observation;
}

mrpt::obs::CObservationRobotPose::Ptr odometry3d(double stamp, const std::string& label,
                                                 const Pose3& odom_T_base) {
  auto odometry = make<mrpt::obs::CObservationRobotPose>(stamp, label);
  odometry->pose.mean = toMrpt(odom_T_base);
  odometry->pose.cov.setZero();
  return odometry;
}

mrpt::obs::CObservationOdometry::Ptr wheelOdometry(double stamp, const std::string& label,
                                                   const Pose3& odom_T_base) {
  auto odometry = make<mrpt::obs::CObservationOdometry>(stamp, label);
  odometry->odometry = toMrptPlanar(odom_T_base);
  return odometry;
}

mrpt::obs::CObservationPointCloud::Ptr scan3d(double stamp, const std::string& label,
                                              const Pose3& world_T_base, const BoxWorld& world,
                                              Noise& noise) {
  auto scan = make<mrpt::obs::CObservationPointCloud>(stamp, label);
  scan->sensorPose = mrpt::poses::CPose3D::FromTranslation(0, 0, kLidarHeight);
  auto points = mrpt::maps::CSimplePointsMap::Create();
  const Eigen::Vector3d origin = world_T_base * Eigen::Vector3d(0, 0, kLidarHeight);
  for (int row = 0; row < kRows; ++row) {
    const double elevation = kLowest + (kHighest - kLowest) * row / (kRows - 1);
    for (int column = 0; column < kColumns; ++column) {
      const double azimuth = 2 * M_PI * column / kColumns;
      const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      const double range = world.range(origin, world_T_base.linear() * ray);
      if (range > kMaxRange) continue;
      const Eigen::Vector3f point = ((range + noise(kRangeNoise)) * ray).cast<float>();
      points->insertPointFast(point.x(), point.y(), point.z());
    }
  }
  scan->pointcloud = points;
  return scan;
}

mrpt::obs::CObservation2DRangeScan::Ptr laserScan(double stamp, const std::string& label,
                                                  const Pose3& world_T_base, const BoxWorld& world,
                                                  Noise& noise) {
  auto scan = make<mrpt::obs::CObservation2DRangeScan>(stamp, label);
  scan->aperture = static_cast<float>(2 * M_PI * (kRays - 1) / kRays);
  scan->maxRange = kMaxRange;
  scan->resizeScan(kRays);
  const Eigen::Vector3d origin = world_T_base * Eigen::Vector3d(0, 0, kLidarHeight);
  for (size_t i = 0; i < kRays; ++i) {
    const double angle = scan->getScanAngle(i);
    const Eigen::Vector3d ray(std::cos(angle), std::sin(angle), 0);
    const double range = world.range(origin, world_T_base.linear() * ray);
    scan->setScanRangeValidity(i, range < kMaxRange);
    scan->setScanRange(
        i, range < kMaxRange ? static_cast<float>(range + noise(kRangeNoise)) : kMaxRange);
  }
  return scan;
}

mrpt::obs::CActionCollection::Ptr movement(double stamp, const Pose3& motion) {
  mrpt::obs::CActionRobotMovement2D action;
  action.timestamp = mrpt::Clock::fromDouble(stamp);
  action.computeFromOdometry(toMrptPlanar(motion), {});
  auto actions = mrpt::obs::CActionCollection::Create();
  actions->insert(action);
  return actions;
}

std::vector<Eigen::Vector2d> moved(std::vector<Eigen::Vector2d> route,
                                   const Eigen::Vector2d& origin) {
  for (Eigen::Vector2d& point : route) point += origin;
  return route;
}

}  // namespace

Recording SyntheticRobot::record3d(const BoxWorld& world) const {
  Noise noise = gaussian(seed);
  const std::vector<Pose3> truth = sway(drive(route));
  const std::vector<Pose3> odometry = deadReckoning(truth, *this, false, noise);
  Recording recording;
  for (size_t i = 0; i < truth.size(); ++i) {
    const double stamp = start_stamp + kSecondsPerStep * static_cast<double>(i);
    recording.objects.push_back(odometry3d(stamp, name + "/odom", odometry[i]));
    if (i % kStepsPerScan != 0) continue;
    recording.objects.push_back(scan3d(stamp, name + "/lidar", truth[i], world, noise));
    recording.truth.push_back({stamp, truth[i]});
  }
  return recording;
}

Recording SyntheticRobot::recordPlanar(const BoxWorld& world) const {
  Noise noise = gaussian(seed);
  const std::vector<Pose3> truth = drive(route);
  const std::vector<Pose3> odometry = deadReckoning(truth, *this, true, noise);
  Recording recording;
  for (size_t i = 0; i < truth.size(); ++i) {
    const double stamp = start_stamp + kSecondsPerStep * static_cast<double>(i);
    recording.objects.push_back(wheelOdometry(stamp, name + "/odom", odometry[i]));
    if (i % kStepsPerScan != 0) continue;
    recording.objects.push_back(laserScan(stamp, name + "/laser", truth[i], world, noise));
    recording.truth.push_back({stamp, truth[i]});
  }
  return recording;
}

Recording SyntheticRobot::recordPlanarPairs(const BoxWorld& world) const {
  Noise noise = gaussian(seed);
  const std::vector<Pose3> truth = drive(route);
  const std::vector<Pose3> odometry = deadReckoning(truth, *this, true, noise);
  Recording recording;
  for (size_t i = 0; i < truth.size(); i += kStepsPerScan) {
    const double stamp = start_stamp + kSecondsPerStep * static_cast<double>(i);
    const size_t before = i < kStepsPerScan ? i : i - kStepsPerScan;
    recording.objects.push_back(movement(stamp, odometry[before].inverse() * odometry[i]));
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(laserScan(stamp, name + "/laser", truth[i], world, noise));
    recording.objects.push_back(frame);
    recording.truth.push_back({stamp, truth[i]});
  }
  return recording;
}

std::vector<Eigen::Vector2d> ringRoute(const Eigen::Vector2d& origin) {
  return moved({{3, 3}, {17, 3}, {17, 12}, {3, 12}, {3, 3}, {9, 3}}, origin);
}

std::vector<Eigen::Vector2d> oppositeRoute() {
  return {{17, 9}, {17, 3}, {3, 3}, {3, 9}};
}

std::vector<Eigen::Vector2d> shortRoute(const Eigen::Vector2d& origin) {
  return moved({{3, 3}, {11, 3}}, origin);
}

}  // namespace lamp::test
