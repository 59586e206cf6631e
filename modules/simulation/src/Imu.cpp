#include "lamp/simulation/Imu.h"

#include <algorithm>
#include <cmath>

#include "SampleStamps.h"
#include "lamp/simulation/Random.h"

namespace lamp::simulation {
namespace {

using Eigen::Vector3d;

Vector3d noise(Random& random, double sigma) {
  const double x = normal(random, sigma), y = normal(random, sigma);
  return {x, y, normal(random, sigma)};
}

ImuReading trueReading(const TrajectoryInterpolator& truth, double stamp, double window_s) {
  const double h = 0.5 * window_s;
  ImuReading reading{stamp, Vector3d::Zero(), Vector3d::Zero()};
  Vector3d acceleration = Vector3d::Zero();
  if (truth.end() - truth.begin() >= window_s) {
    const double t =
        std::clamp(stamp, truth.begin() + h, std::max(truth.begin() + h, truth.end() - h));
    const Pose3 before = truth.at(t - h), at = truth.at(t), after = truth.at(t + h);
    acceleration = (after.translation() - 2.0 * at.translation() + before.translation()) / (h * h);
    reading.angular_velocity = logSE3(before.inverse() * after).tail<3>() / window_s;
  }
  const Eigen::Matrix3d base_R_world = truth.at(stamp).linear().transpose();
  reading.specific_force = base_R_world * (acceleration + kGravity_m_s2 * Vector3d::UnitZ());
  return reading;
}

/** A first-order Gauss-Markov process on each axis. */
class Bias {
 public:
  Bias(double sigma, double keep, Random& random)
      : sigma_(sigma), keep_(keep), value_(noise(random, sigma)) {}
  const Vector3d& value() const { return value_; }
  void advance(Random& random) {
    value_ = keep_ * value_ + std::sqrt(1.0 - keep_ * keep_) * noise(random, sigma_);
  }

 private:
  double sigma_, keep_;
  Vector3d value_;
};

}  // namespace

void ImuOptions::visit(OptionVisitor& v) {
  v("rate_hz", rate_hz, "Hz", "readings per second", kPositive);
  v("gyro_sigma_rad_s", gyro_sigma_rad_s, "rad/s", "noise of a turn rate", kNotNegative);
  v("gyro_bias_rad_s", gyro_bias_rad_s, "rad/s", "size of the gyros' biases", kNotNegative);
  v("accel_sigma_m_s2", accel_sigma_m_s2, "m/s2", "noise of an acceleration", kNotNegative);
  v("accel_bias_m_s2", accel_bias_m_s2, "m/s2", "size of the accelerometers' biases", kNotNegative);
  v("bias_time_s", bias_time_s, "s", "time over which biases change", kPositive);
  v("window_s", window_s, "s", "time over which the true motion is differentiated", kPositive);
}

std::vector<ImuReading> simulateImu(const TrajectoryInterpolator& truth, const ImuOptions& options,
                                    uint64_t seed) {
  Random random(mixSeeds({seed}));
  const double keep = std::exp(-1.0 / (options.rate_hz * options.bias_time_s));
  Bias gyro(options.gyro_bias_rad_s, keep, random), accel(options.accel_bias_m_s2, keep, random);
  std::vector<ImuReading> readings;
  for (const double stamp : sampleStamps(truth, options.rate_hz)) {
    ImuReading reading = trueReading(truth, stamp, options.window_s);
    reading.angular_velocity += gyro.value() + noise(random, options.gyro_sigma_rad_s);
    reading.specific_force += accel.value() + noise(random, options.accel_sigma_m_s2);
    readings.push_back(reading);
    gyro.advance(random);
    accel.advance(random);
  }
  return readings;
}

}  // namespace lamp::simulation
