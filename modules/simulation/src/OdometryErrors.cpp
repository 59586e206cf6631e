#include "OdometryErrors.h"

#include <cmath>

namespace lamp::simulation {
namespace {

/** A robot at rest creeps a little, so that covariances always grow: per square root of second. */
constexpr double kRest_m = 1e-4, kRest_rad = 1e-5;
/** The longest motion for which the claim on roll and pitch is honest, even from an upright start.
 */
constexpr double kLongestHonestWay_m = 100.0;

double square(double x) {
  return x * x;
}
double radians(double degrees) {
  return degrees * M_PI / 180.0;
}

/** First-order Gauss-Markov process over the way, stationary from the start. */
class GaussMarkov {
 public:
  GaussMarkov(double sigma, double correlation_m, Random& random)
      : sigma_(sigma), correlation_m_(correlation_m), value_(normal(random, sigma)) {}
  double advance(double way_m, Random& random) {
    const double keep = std::exp(-way_m / correlation_m_);
    value_ = keep * value_ + std::sqrt(1.0 - keep * keep) * normal(random, sigma_);
    return value_;
  }

 private:
  double sigma_, correlation_m_, value_;
};

Vector6d whiteNoise(Random& random, double translation_sigma, const Eigen::Vector3d& rotation) {
  Vector6d e;
  for (int axis = 0; axis < 3; ++axis) e[axis] = normal(random, translation_sigma);
  for (int axis = 0; axis < 3; ++axis) e[3 + axis] = normal(random, rotation[axis]);
  return e;
}

Vector6d walkError(const OdometryStep& step, const OdometryOptions& o, Random& random) {
  const double way = step.way_m(), rest = step.seconds;
  const double tilt = std::sqrt(square(o.tilt_rad_per_sqrt_m) * way + square(kRest_rad) * rest);
  const double heading =
      std::sqrt(square(o.heading_rad_per_sqrt_m) * way +
                square(o.turn_rad_per_sqrt_rad) * step.turned_rad() + square(kRest_rad) * rest);
  const double position = std::sqrt(square(o.position_m_per_sqrt_m) * way + square(kRest_m) * rest);
  return whiteNoise(random, position, {tilt, tilt, heading});
}

/** Claims white noise for a walk of density `walk` and a process that adds up to `slow` over long
 * ways: see simulateOdometry(). */
double claim(double walk, double slow) {
  return std::sqrt(walk * (walk + slow));
}

/** Share of a walk's variance that gravity leaves over a way that begins upright. */
double shareLeft(double way_m, double gravity_m) {
  const double x = 2.0 * way_m / gravity_m;
  return (1.0 - std::exp(-x)) / x;
}

}  // namespace

std::vector<Vector6d> drawStepErrors(const std::vector<OdometryStep>& steps,
                                     const OdometryOptions& o, Random& random) {
  GaussMarkov scale(o.scale_sigma, o.correlation_m, random);
  GaussMarkov heading(o.heading_bias_rad_per_m, o.correlation_m, random);
  std::vector<Vector6d> errors;
  errors.reserve(steps.size());
  for (const OdometryStep& step : steps) {
    const double way = step.way_m();
    Vector6d e = walkError(step, o, random);
    e.head<3>() += scale.advance(way, random) * step.motion.translation();
    e[5] += heading.advance(way, random) * way;
    if (chance(random, o.bumps_per_m * way))
      for (int axis = 3; axis < 6; ++axis) e[axis] += normal(random, radians(o.bump_sigma_deg));
    if (chance(random, o.slips_per_m * way))
      e.head<3>() += normal(random, o.slip_sigma_m) / way * step.motion.translation();
    e.head<3>() = (step.motion.linear().transpose() * e.head<3>()).eval();
    errors.push_back(e);
  }
  return errors;
}

Matrix6d claimedStepCovariance(const OdometryStep& step, const OdometryOptions& o) {
  const double way = step.way_m();
  const double bumps = o.bumps_per_m * square(radians(o.bump_sigma_deg));
  const double sideways = square(o.position_m_per_sqrt_m);
  const double along = claim(sideways + o.slips_per_m * square(o.slip_sigma_m),
                             2.0 * square(o.scale_sigma) * o.correlation_m);
  const double tilt = (square(o.tilt_rad_per_sqrt_m) + bumps) *
                      std::sqrt(shareLeft(kLongestHonestWay_m, o.gravity_m));
  const double heading = claim(square(o.heading_rad_per_sqrt_m) + bumps,
                               2.0 * square(o.heading_bias_rad_per_m) * o.correlation_m);
  Matrix6d Q = Matrix6d::Zero();
  Q.diagonal() << Eigen::Vector3d::Constant(sideways * way),
      Eigen::Vector3d(tilt, tilt, heading) * way;
  Q(5, 5) += square(o.turn_rad_per_sqrt_rad) * step.turned_rad();
  Q.diagonal().head<3>().array() += square(kRest_m) * step.seconds;
  Q.diagonal().tail<3>().array() += square(kRest_rad) * step.seconds;
  if (way > 0) {
    const Eigen::Vector3d t = step.motion.linear().transpose() * step.motion.translation();
    Q.topLeftCorner<3, 3>() += (along - sideways) / way * t * t.transpose();
  }
  return Q;
}

}  // namespace lamp::simulation
