#include "lamp/simulation/OdometryModel.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include <cmath>
#include <map>

#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;

/** Growth of the covariance from one sample to another, as the front end takes it. */
Matrix6d growth(const SimulatedOdometry& odometry, size_t from, size_t to) {
  const Pose3 motion = odometry.odom_T_base[from].pose.inverse() * odometry.odom_T_base[to].pose;
  return odometry.covariances[to] -
         composeCovariance(odometry.covariances[from], motion, Matrix6d::Zero());
}

Vector6d motionError(const TrajectoryInterpolator& truth, const SimulatedOdometry& odometry,
                     size_t from, size_t to) {
  const StampedPose &a = odometry.odom_T_base[from], &b = odometry.odom_T_base[to];
  const Pose3 true_motion = truth.at(a.stamp).inverse() * truth.at(b.stamp);
  return logSE3(true_motion.inverse() * a.pose.inverse() * b.pose);
}

/** Errors of motions over their claimed sigmas, axis by axis. */
struct Honesty {
  Vector6d sum = Vector6d::Zero(), sum_of_squares = Vector6d::Zero();
  int count = 0, beyond_95 = 0;

  void add(const TrajectoryInterpolator& truth, const SimulatedOdometry& odometry, size_t step) {
    for (size_t from = 0; from + step < odometry.odom_T_base.size(); from += step, ++count) {
      const Matrix6d covariance = growth(odometry, from, from + step);
      const Vector6d error = motionError(truth, odometry, from, from + step);
      const Vector6d e = error.cwiseQuotient(covariance.diagonal().cwiseSqrt());
      sum += e;
      sum_of_squares += e.cwiseAbs2();
      beyond_95 += error.dot(covariance.ldlt().solve(error)) > 12.592;  // chi², 6 degrees
    }
  }
  Vector6d mean() const { return sum / count; }
  Vector6d normalisedVariance() const { return sum_of_squares / count; }
};

std::map<int, Honesty> honestyOver(const std::vector<int>& metres, const OdometryOptions& options,
                                   int seeds) {
  const auto truth = winding(220);  // 1 m/s
  std::map<int, Honesty> honesty;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto odometry = simulateOdometry(truth, options, 1000 + seed);
    for (const int m : metres)
      honesty[m].add(truth, odometry, static_cast<size_t>(m * options.rate_hz));
  }
  return honesty;
}

double driftPercent(const TrajectoryInterpolator& truth, const SimulatedOdometry& odometry) {
  constexpr size_t kHundredMetres = 1000;
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i + kHundredMetres < odometry.odom_T_base.size(); i += 100, ++count)
    sum += motionError(truth, odometry, i, i + kHundredMetres).head<3>().norm();
  return sum / static_cast<double>(count);
}

TEST(OdometryModel, StartsAtTheIdentityAndCoversTheTruth) {
  const auto truth = steady(2.34, (Vector6d() << 1, 0, 0, 0, 0, 0.5).finished());
  const auto odometry = simulateOdometry(truth, {}, 1);
  ASSERT_EQ(odometry.odom_T_base.size(), odometry.covariances.size());
  EXPECT_TRUE(odometry.odom_T_base.front().pose.matrix().isIdentity());
  EXPECT_EQ(odometry.odom_T_base.front().stamp, truth.begin());
  EXPECT_NEAR(odometry.odom_T_base.back().stamp, truth.end(), 1e-6);
  for (size_t i = 1; i < odometry.odom_T_base.size(); ++i)
    EXPECT_GT(odometry.odom_T_base[i].stamp, odometry.odom_T_base[i - 1].stamp);
}

TEST(OdometryModel, WithoutErrorsIsTheTruth) {
  OdometryOptions options;
  options.scale_sigma = options.heading_bias_rad_per_m = options.position_m_per_sqrt_m = 0;
  options.heading_rad_per_sqrt_m = options.turn_rad_per_sqrt_rad = options.tilt_rad_per_sqrt_m = 0;
  options.bumps_per_m = options.slips_per_m = 0;
  const auto odometry = simulateOdometry(winding(100), options, 1);
  EXPECT_LT(odometry.ate_m, 0.01) << "but for the creeping at rest";
}

TEST(OdometryModel, IsUnbiasedAndHonestFromTwoToAHundredMetres) {
  OdometryOptions options;
  options.rate_hz = 5;
  for (const auto& [metres, honesty] : honestyOver({2, 10, 30, 100}, options, 300)) {
    const double beyond = static_cast<double>(honesty.beyond_95) / honesty.count;
    EXPECT_GT(beyond, 0.02) << metres << " m";
    EXPECT_LT(beyond, 0.10) << metres << " m";
    for (int axis = 0; axis < 6; ++axis) {
      EXPECT_GT(honesty.normalisedVariance()[axis], 0.5) << metres << " m, axis " << axis;
      EXPECT_LT(honesty.normalisedVariance()[axis], 2.0) << metres << " m, axis " << axis;
      EXPECT_NEAR(honesty.mean()[axis], 0, 0.15) << metres << " m, axis " << axis;
    }
  }
}

TEST(OdometryModel, DriftsLikeOdometry) {
  const auto truth = winding(600);
  double sum = 0;
  for (int seed = 0; seed < 20; ++seed)
    sum += driftPercent(truth, simulateOdometry(truth, {}, seed));
  EXPECT_GT(sum / 20, 0.3);
  EXPECT_LT(sum / 20, 2.0);
}

TEST(OdometryModel, GravityBoundsRollAndPitchButNotHeading) {
  const auto truth = winding(3000);
  OdometryOptions options;
  options.rate_hz = 1;
  double tilt = 0, heading = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const auto odometry = simulateOdometry(truth, options, seed);
    const Vector6d e = motionError(truth, odometry, 0, odometry.odom_T_base.size() - 1);
    tilt += e.segment<2>(3).squaredNorm() / 2 / 20;
    heading += e[5] * e[5] / 20;
  }
  EXPECT_LT(std::sqrt(tilt), 0.012) << "rad";
  EXPECT_GT(std::sqrt(heading), 0.03) << "rad";
}

TEST(OdometryModel, CovarianceFactorMultipliesSigmas) {
  OdometryOptions options;
  const auto truth = winding(50);
  const auto honest = simulateOdometry(truth, options, 1);
  for (const double factor : {0.1, 10.0}) {
    options.covariance_factor = factor;
    const auto other = simulateOdometry(truth, options, 1);
    const Matrix6d a = growth(honest, 100, 300), b = growth(other, 100, 300);
    EXPECT_TRUE(b.isApprox(factor * factor * a, 1e-6));
    EXPECT_TRUE(other.odom_T_base.back().pose.isApprox(honest.odom_T_base.back().pose, 0));
  }
}

TEST(OdometryModel, CovariancesGrowOverEveryStep) {
  const auto odometry = simulateOdometry(winding(1000), {}, 1);
  for (size_t i = 10; i < odometry.odom_T_base.size(); i += 10) {
    EXPECT_TRUE(isCovariance(odometry.covariances[i]));
    EXPECT_TRUE(isCovariance(growth(odometry, i - 10, i))) << i;
  }
}

TEST(OdometryModel, ErrorsGrowUntilTheAteIsReached) {
  const auto truth = winding(300);
  OdometryOptions options;
  const auto plain = simulateOdometry(truth, options, 4);
  EXPECT_EQ(plain.error_scale, 1);
  options.min_ate_m = 0.5 * plain.ate_m;
  EXPECT_EQ(simulateOdometry(truth, options, 4).error_scale, 1) << "reached already";
  options.min_ate_m = 3 * plain.ate_m;
  const auto scaled = simulateOdometry(truth, options, 4);
  EXPECT_GE(scaled.ate_m, options.min_ate_m);
  EXPECT_LT(scaled.ate_m, 1.01 * options.min_ate_m);
  EXPECT_NEAR(scaled.error_scale, 3, 0.3);
  double sum = 0;
  const auto odometry = scaled.interpolator();
  for (const StampedPose& p : scaled.odom_T_base)
    sum += (truth.at(truth.begin()) * odometry.at(p.stamp).translation() -
            truth.at(p.stamp).translation())
               .norm();
  EXPECT_NEAR(sum / static_cast<double>(scaled.odom_T_base.size()), scaled.ate_m, 1e-9);
}

TEST(OdometryModel, ScaledErrorsStayHonest) {
  OdometryOptions options;
  options.rate_hz = 2;
  options.min_ate_m = 3;
  const Honesty honesty = honestyOver({30}, options, 60).at(30);
  for (int axis = 0; axis < 6; ++axis) {
    EXPECT_GT(honesty.normalisedVariance()[axis], 0.4) << axis;
    EXPECT_LT(honesty.normalisedVariance()[axis], 2.5) << axis;
  }
}

TEST(OdometryModel, SameSeedSameResult) {
  const auto truth = winding(60);
  const auto a = simulateOdometry(truth, {}, 1), b = simulateOdometry(truth, {}, 1);
  const auto c = simulateOdometry(truth, {}, 2);
  EXPECT_EQ(a.odom_T_base.back().pose.matrix(), b.odom_T_base.back().pose.matrix());
  EXPECT_EQ(a.covariances.back(), b.covariances.back());
  EXPECT_NE(a.odom_T_base.back().pose.matrix(), c.odom_T_base.back().pose.matrix());
}

TEST(OdometryModel, ARobotAtRestStaysPut) {
  OdometryOptions options;
  options.min_ate_m = 1;
  const auto odometry = simulateOdometry(standing(60), options, 1);
  for (const StampedPose& p : odometry.odom_T_base) EXPECT_TRUE(isFinite(p.pose));
  EXPECT_LT(odometry.ate_m, 0.2) << "it cannot reach the ATE";
  EXPECT_TRUE(isCovariance(growth(odometry, 0, 600)));
}

TEST(OdometryModel, RefusesARateOfZero) {
  OdometryOptions options;
  options.rate_hz = 0;
  EXPECT_THROW(simulateOdometry(standing(1), options, 1), std::runtime_error);
}

TEST(OdometryModel, ATruthOfOnePoseGivesOnePose) {
  const TrajectoryInterpolator point({{kBegin, Pose3::Identity()}});
  OdometryOptions options;
  options.min_ate_m = 1;
  const auto odometry = simulateOdometry(point, options, 1);
  ASSERT_EQ(odometry.odom_T_base.size(), 1u);
  EXPECT_TRUE(odometry.odom_T_base[0].pose.matrix().isIdentity());
  EXPECT_EQ(odometry.ate_m, 0);
}

}  // namespace
}  // namespace lamp::simulation
