#pragma once

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationRotatingScan.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lamp/core/GraphFiles.h"
#include "lamp/input/ObservationSource.h"

namespace lamp::test {

constexpr RobotId kRobot{3};
constexpr double kDegree = M_PI / 180.0;
/** A stamp of our days: it must not matter that seconds since 1970 are many. */
constexpr double kStart = 1.6e9;

inline Vector6d tangent(double x, double y, double z, double rx, double ry, double rz) {
  Vector6d v;
  v << x, y, z, rx, ry, rz;
  return v;
}

inline InputObservation wrapped(double stamp, const std::string& label,
                                const mrpt::obs::CObservation::Ptr& observation) {
  observation->timestamp = mrpt::Clock::fromDouble(stamp);
  observation->sensorLabel = label;
  return {kRobot, label, stamp, observation};
}

inline InputObservation wheels(double stamp, double x, double y = 0, double yaw = 0) {
  auto observation = mrpt::obs::CObservationOdometry::Create();
  observation->odometry = mrpt::poses::CPose2D(x, y, yaw);
  return wrapped(stamp, "wheels", observation);
}

/** \param covariance in our tangent space; none is recorded as zeros. */
inline InputObservation robotPose(double stamp, const Pose3& odom_T_base,
                                  const Matrix6d& covariance = Matrix6d::Zero()) {
  const Vector6d v = yawPitchRollFromPose(odom_T_base);
  auto observation = mrpt::obs::CObservationRobotPose::Create();
  observation->pose.mean = mrpt::poses::CPose3D(v[0], v[1], v[2], v[3], v[4], v[5]);
  observation->pose.cov.setZero();
  if (!covariance.isZero()) {
    const Matrix6d recorded = covarianceToMrpt(odom_T_base, covariance);
    for (int i = 0; i < 36; ++i) observation->pose.cov(i / 6, i % 6) = recorded(i / 6, i % 6);
  }
  return wrapped(stamp, "pose", observation);
}

/** A cloud with these points in the frame of a lidar at `base_p_lidar`. */
inline InputObservation cloud(double stamp, const std::vector<Eigen::Vector3f>& points,
                              const std::string& label = "lidar",
                              const Eigen::Vector3d& base_p_lidar = Eigen::Vector3d::Zero()) {
  auto map = mrpt::maps::CSimplePointsMap::Create();
  for (const auto& p : points) map->insertPoint(p.x(), p.y(), p.z());
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->pointcloud = map;
  observation->sensorPose =
      mrpt::poses::CPose3D(base_p_lidar.x(), base_p_lidar.y(), base_p_lidar.z(), 0, 0, 0);
  return wrapped(stamp, label, observation);
}

/** Points that no voxel joins. */
inline std::vector<Eigen::Vector3f> somePoints() {
  return {{5, 0, 0}, {0, 5, 0}, {-5, 0, 2}, {0, -5, 2}};
}

/** What a lidar with eight rings sees from (x, y, 0) in a hall of 30 by 12 m with two pillars. */
inline std::vector<Eigen::Vector3f> hallSeenFrom(double x, double y) {
  std::vector<Eigen::Vector3f> points;
  const Eigen::Vector3d at(x, y, 0);
  for (int ring = 0; ring < 8; ++ring)
    for (int step = 0; step < 360; ++step) {
      const double azimuth = step * kDegree, elevation = (4 * ring - 14) * kDegree;
      const Eigen::Vector3d ray(std::cos(azimuth) * std::cos(elevation),
                                std::sin(azimuth) * std::cos(elevation), std::sin(elevation));
      double range = 100;
      const auto wall = [&](int axis, double place) {
        const double r = (place - at[axis]) / ray[axis];
        if (r > 0) range = std::min(range, r);
      };
      const auto pillar = [&](double px, double py, double radius) {
        const Eigen::Vector2d to(px - x, py - y), flat = ray.head<2>();
        const double along = to.dot(flat) / flat.squaredNorm();
        const double beside = (to - along * flat).norm();
        if (along <= 0 || beside >= radius) return;
        range = std::min(
            range, along - std::sqrt((radius * radius - beside * beside) / flat.squaredNorm()));
      };
      wall(0, -10), wall(0, 20), wall(1, -5), wall(1, 7), wall(2, -1), wall(2, 4);
      pillar(4, 3, 0.6), pillar(9, -2, 0.8);
      points.push_back((range * ray).cast<float>());
    }
  return points;
}

/** A round room of 5 m radius, seen by a 2D laser. */
inline InputObservation laser(double stamp, double pitch_deg = 0, double roll_deg = 0) {
  auto observation = mrpt::obs::CObservation2DRangeScan::Create();
  constexpr size_t kRays = 181;
  observation->aperture = static_cast<float>(M_PI);
  observation->maxRange = 30;
  observation->resizeScan(kRays);
  for (size_t i = 0; i < kRays; ++i) {
    observation->setScanRange(i, 5.0f);
    observation->setScanRangeValidity(i, true);
  }
  observation->sensorPose =
      mrpt::poses::CPose3D(0.2, 0, 0.4, 0, pitch_deg * kDegree, roll_deg * kDegree);
  return wrapped(stamp, "laser", observation);
}

}  // namespace lamp::test
