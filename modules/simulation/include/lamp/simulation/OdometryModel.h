#pragma once

#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Trajectory.h"

namespace lamp::simulation {

/** Errors of a lidar/IMU odometry. Densities per square root are random walks. */
struct OdometryOptions {
  double rate_hz = 10;
  double scale_sigma = 0.005;
  double heading_bias_rad_per_m = 0.00016;
  double correlation_m = 20;
  double position_m_per_sqrt_m = 0.025;
  double heading_rad_per_sqrt_m = 0.001;
  double turn_rad_per_sqrt_rad = 0.004;
  double tilt_rad_per_sqrt_m = 0.0004;
  double gravity_m = 150;
  double bumps_per_m = 0.005;
  double bump_sigma_deg = 0.3;
  double slips_per_m = 0.002;
  double slip_sigma_m = 0.2;
  double min_ate_m = 0;
  double covariance_factor = 1;

  void visit(OptionVisitor& v);
};

struct SimulatedOdometry {
  std::vector<StampedPose> odom_T_base;  ///< the first is the identity; time order
  /** Of each pose, in the tangent space at it. The covariance of the motion between two poses is
   * the growth from one to the other. */
  std::vector<Matrix6d> covariances;
  double error_scale = 1;  ///< by which the errors were scaled up to reach `min_ate_m`
  double ate_m = 0;        ///< mean, laid from the true start pose

  TrajectoryInterpolator interpolator() const { return TrajectoryInterpolator(odom_T_base); }
};

/** Dead reckoning: the true motion from sample to sample, each with an error.
 *
 * - Position and heading err by a random walk; so do they per turned angle, by rare bumps (jumps in
 *   all three angles) and slips (jumps along the way).
 * - Scale and heading bias change slowly: first-order Gauss-Markov processes over the way.
 * - Roll and pitch walk too, but gravity pulls them back over `gravity_m`; height drifts with
 * pitch.
 *
 * The covariances claim white noise, though Gauss-Markov errors are not. Their spectrum lies
 * between that of the walk alone (`w`, short ways) and `w + g`, `g = 2 sigma² correlation_m` (long
 * ways). Claiming `sqrt(w (w + g))` errs by at most `sqrt(1 + g/w)` for every motion, however long
 * or curved: 1.6 with the defaults. Roll and pitch are claimed in the same way for up to 100 m;
 * beyond, their claim is too large.
 *
 * With `min_ate_m`, all errors are scaled up until the ATE reaches it. A robot that cannot reach it
 * with fifty times the errors stays below; `ate_m` tells.
 *
 * \param truth `world_T_base` */
SimulatedOdometry simulateOdometry(const TrajectoryInterpolator& truth,
                                   const OdometryOptions& options, uint64_t seed);

}  // namespace lamp::simulation
