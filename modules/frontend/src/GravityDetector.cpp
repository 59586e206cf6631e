#include "lamp/frontend/GravityDetector.h"

#include <cmath>

namespace lamp {

namespace {

constexpr double kGravity_m_s2 = 9.81;
/** By latitude, height and bias of the sensor. */
constexpr double kMaxDifference_m_s2 = 0.5;
constexpr size_t kFewestSamples = 10;

}  // namespace

void GravityOptions::visit(OptionVisitor& v) {
  v("gravity_window_s", gravity_window_s, "s",
    "roll and pitch are taken from an IMU that has felt nothing but gravity for this long",
    kPositive);
  v("gravity_max_turn_rad_s", gravity_max_turn_rad_s, "rad/s", "maximum turn rate during that time",
    kPositive);
  v("gravity_max_change_m_s2", gravity_max_change_m_s2, "m/s2",
    "maximum difference between the mean accelerations in the two halves of that time", kPositive);
  v("gravity_max_shake_m_s2", gravity_max_shake_m_s2, "m/s2",
    "maximum standard deviation of the acceleration during that time: a robot that drives shakes, "
    "one whose fans and motors run does a little",
    kPositive);
  v("gravity_sigma_deg", gravity_sigma_deg, "deg",
    "standard deviation of roll and pitch measured this way: mounting error and biases of the IMU",
    kPositive);
}

std::optional<GravityReading> GravityDetector::observe(double stamp,
                                                       const InertialReading& reading) {
  if (!window_.empty() && stamp <= window_.back().stamp) return std::nullopt;
  if (reading.angular_velocity.norm() > options_.gravity_max_turn_rad_s) {
    window_.clear();
    return std::nullopt;
  }
  window_.push_back({stamp, reading});
  const double begin = stamp - options_.gravity_window_s;
  if (window_.front().stamp > begin || window_.size() < kFewestSamples) return std::nullopt;
  while (window_[1].stamp <= begin) window_.pop_front();

  Eigen::Vector3d halves[2] = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  const size_t half = window_.size() / 2;
  for (size_t i = 0; i < 2 * half; ++i)
    halves[i / half] += window_[i].reading.specific_force / static_cast<double>(half);
  const Eigen::Vector3d mean = 0.5 * (halves[0] + halves[1]);
  double shake2 = 0;
  for (const Sample& sample : window_)
    shake2 += (sample.reading.specific_force - mean).squaredNorm();
  shake2 /= static_cast<double>(window_.size());
  const bool even = shake2 <= std::pow(options_.gravity_max_shake_m_s2, 2) &&
                    (halves[0] - halves[1]).norm() <= options_.gravity_max_change_m_s2 &&
                    std::abs(mean.norm() - kGravity_m_s2) <= kMaxDifference_m_s2;
  if (!even) return std::nullopt;
  return GravityReading{stamp, mean.normalized(), options_.gravity_sigma_deg * M_PI / 180.0};
}

}  // namespace lamp
