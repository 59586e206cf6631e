#include "lamp/simulation/OdometryModel.h"

#include <algorithm>

#include "OdometryErrors.h"
#include "SampleStamps.h"

namespace lamp::simulation {
namespace {

constexpr double kMaxErrorScale = 50.0;
/** So small that it says "known", and still a covariance. */
constexpr double kStartVariance = 1e-8;

std::vector<StampedPose> sampleTruth(const TrajectoryInterpolator& truth, double rate_hz) {
  std::vector<double> stamps = sampleStamps(truth, rate_hz);
  if (truth.end() - stamps.back() > 1e-6) stamps.push_back(truth.end());
  std::vector<StampedPose> samples;
  samples.reserve(stamps.size());
  for (const double stamp : stamps) samples.push_back({stamp, truth.at(stamp)});
  return samples;
}

std::vector<OdometryStep> stepsOf(const std::vector<StampedPose>& samples) {
  std::vector<OdometryStep> steps;
  for (size_t i = 1; i < samples.size(); ++i)
    steps.push_back(
        {samples[i - 1].pose.inverse() * samples[i].pose, samples[i].stamp - samples[i - 1].stamp});
  return steps;
}

/** Dead reckoning from given errors of the steps. */
class Reckoning {
 public:
  Reckoning(std::vector<StampedPose> truth, const OdometryOptions& options, uint64_t seed)
      : truth_(std::move(truth)), steps_(stepsOf(truth_)), gravity_m_(options.gravity_m) {
    Random random(mixSeeds({seed}));
    errors_ = drawStepErrors(steps_, options, random);
  }

  const std::vector<OdometryStep>& steps() const { return steps_; }

  std::vector<StampedPose> integrate(double error_scale) const {
    std::vector<StampedPose> result{{truth_.front().stamp, Pose3::Identity()}};
    result.reserve(truth_.size());
    for (size_t i = 0; i < steps_.size(); ++i) {
      const Pose3 reckoned =
          result.back().pose * steps_[i].motion * expSE3(error_scale * errors_[i]);
      result.push_back({truth_[i + 1].stamp, pulledUpright(reckoned, i + 1)});
    }
    return result;
  }

  double ate(const std::vector<StampedPose>& odometry) const {
    const Pose3& world_T_odom = truth_.front().pose;
    double sum = 0;
    for (size_t i = 0; i < truth_.size(); ++i)
      sum += (world_T_odom * odometry[i].pose.translation() - truth_[i].pose.translation()).norm();
    return sum / static_cast<double>(truth_.size());
  }

 private:
  /** Turns the pose a little so that its down comes nearer to the true one. */
  Pose3 pulledUpright(const Pose3& odom_T_base, size_t sample) const {
    const Eigen::Vector3d odom_up = truth_.front().pose.linear().transpose().col(2);
    const Eigen::Vector3d true_up = truth_[sample].pose.linear().transpose().col(2);
    const Eigen::Vector3d up = odom_T_base.linear().transpose() * odom_up;
    const double share = std::min(1.0, steps_[sample - 1].way_m() / gravity_m_);
    Vector6d pull = Vector6d::Zero();
    pull.tail<3>() = -share * up.cross(true_up);
    return normalized(odom_T_base * expSE3(pull));
  }

  std::vector<StampedPose> truth_;
  std::vector<OdometryStep> steps_;
  std::vector<Vector6d> errors_;
  double gravity_m_;
};

/** The least scale from 1 with which the ATE reaches a value, to a thousandth from above. */
double scaleForAte(const Reckoning& reckoning, double min_ate_m) {
  const auto reached = [&](double scale) {
    return reckoning.ate(reckoning.integrate(scale)) >= min_ate_m;
  };
  if (reached(1.0)) return 1.0;
  double low = 1.0, high = 2.0;
  while (high < kMaxErrorScale && !reached(high)) {
    low = high;
    high *= 2.0;
  }
  if (high >= kMaxErrorScale && !reached(kMaxErrorScale)) return kMaxErrorScale;
  high = std::min(high, kMaxErrorScale);
  while (high - low > 1e-3 * low) {
    const double middle = 0.5 * (low + high);
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

std::vector<Matrix6d> accumulatedCovariances(const std::vector<StampedPose>& poses,
                                             const std::vector<OdometryStep>& steps,
                                             const OdometryOptions& options, double error_scale) {
  const double factor = error_scale * options.covariance_factor;
  std::vector<Matrix6d> result{kStartVariance * Matrix6d::Identity()};
  result.reserve(poses.size());
  for (size_t i = 0; i < steps.size(); ++i) {
    const Pose3 motion = poses[i].pose.inverse() * poses[i + 1].pose;
    const Matrix6d growth = factor * factor * claimedStepCovariance(steps[i], options);
    const Matrix6d sum = composeCovariance(result.back(), motion, growth);
    result.push_back(0.5 * (sum + sum.transpose()));
  }
  return result;
}

}  // namespace

SimulatedOdometry simulateOdometry(const TrajectoryInterpolator& truth,
                                   const OdometryOptions& options, uint64_t seed) {
  const Reckoning reckoning(sampleTruth(truth, options.rate_hz), options, seed);
  SimulatedOdometry result;
  if (options.min_ate_m > 0) result.error_scale = scaleForAte(reckoning, options.min_ate_m);
  result.odom_T_base = reckoning.integrate(result.error_scale);
  result.covariances =
      accumulatedCovariances(result.odom_T_base, reckoning.steps(), options, result.error_scale);
  result.ate_m = reckoning.ate(result.odom_T_base);
  return result;
}

}  // namespace lamp::simulation
