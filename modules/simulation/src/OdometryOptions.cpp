#include "lamp/simulation/OdometryModel.h"

namespace lamp::simulation {

void OdometryOptions::visit(OptionVisitor& v) {
  v("rate_hz", rate_hz, "Hz", "poses per second", kPositive);
  v("scale_sigma", scale_sigma, "", "slowly varying scale error of the way", kNotNegative);
  v("heading_bias_rad_per_m", heading_bias_rad_per_m, "rad/m",
    "slowly varying heading error per metre", kNotNegative);
  v("correlation_m", correlation_m, "m", "way over which scale and heading bias change", kPositive);
  v("position_m_per_sqrt_m", position_m_per_sqrt_m, "m/sqrt(m)", "random walk of the position",
    kNotNegative);
  v("heading_rad_per_sqrt_m", heading_rad_per_sqrt_m, "rad/sqrt(m)", "random walk of the heading",
    kNotNegative);
  v("turn_rad_per_sqrt_rad", turn_rad_per_sqrt_rad, "rad/sqrt(rad)",
    "random walk of the heading while turning", kNotNegative);
  v("tilt_rad_per_sqrt_m", tilt_rad_per_sqrt_m, "rad/sqrt(m)", "random walk of roll and pitch",
    kNotNegative);
  v("gravity_m", gravity_m, "m", "way over which gravity pulls roll and pitch back", kPositive);
  v("bumps_per_m", bumps_per_m, "1/m", "jumps in roll, pitch and yaw per metre", kNotNegative);
  v("bump_sigma_deg", bump_sigma_deg, "deg", "size of a bump, each angle", kNotNegative);
  v("slips_per_m", slips_per_m, "1/m", "jumps along the way per metre", kNotNegative);
  v("slip_sigma_m", slip_sigma_m, "m", "size of a slip", kNotNegative);
  v("min_ate_m", min_ate_m, "m",
    "errors are scaled up until the mean position error reaches this; 0: never", kNotNegative);
  v("covariance_factor", covariance_factor, "",
    "the sigmas of the covariances times this: 1 is honest, 0.1 and 10 are not", kPositive);
}

}  // namespace lamp::simulation
