#pragma once

#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Trajectory.h"

namespace lamp::simulation {

struct ImuOptions {
  double rate_hz = 100;
  double gyro_sigma_rad_s = 0.002;
  double gyro_bias_rad_s = 0.001;
  double accel_sigma_m_s2 = 0.03;
  double accel_bias_m_s2 = 0.02;
  double bias_time_s = 300;
  double window_s = 0.2;

  void visit(OptionVisitor& v);
};

constexpr double kGravity_m_s2 = 9.80665;

struct ImuReading {
  double stamp = 0;
  Eigen::Vector3d angular_velocity;  ///< rad/s, base frame
  Eigen::Vector3d specific_force;    ///< m/s², base frame; gravity's reaction at rest: +g upwards
};

/** An IMU at the base's origin: finite differences of the true motion over `window_s`, with noise
 * and slowly varying biases. The window must span two samples of the truth, between which the
 * motion is a constant twist, or accelerations come and go with the samples. Near the ends of the
 * motion, and throughout a motion shorter than the window, it reads what it reads at the nearest
 * whole window, or rest. \param truth `world_T_base`, z of world upwards. */
std::vector<ImuReading> simulateImu(const TrajectoryInterpolator& truth, const ImuOptions& options,
                                    uint64_t seed);

}  // namespace lamp::simulation
