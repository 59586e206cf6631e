#include "lamp/core/Geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "MrptSupport.h"
#include "TestSupport.h"

namespace lamp {
namespace {

using test::distance;
using test::matrixOf;
using test::numericalJacobian;
using test::Random;

const double kAngles[] = {0,   1e-14, 1e-9, 1e-5, 9.9e-5,      1.01e-4,     1e-3,
                          0.1, 1,     2,    3,    M_PI - 1e-4, M_PI - 1e-8, M_PI - 1e-12};

/** The 4x4 matrix whose matrix exponential defines Exp(). */
Eigen::Matrix4d hat(const Vector6d& d) {
  Eigen::Matrix4d m = Eigen::Matrix4d::Zero();
  m.topLeftCorner<3, 3>() = skew(d.tail<3>());
  m.topRightCorner<3, 1>() = d.head<3>();
  return m;
}

TEST(Geometry, SkewIsTheCrossProduct) {
  Random random;
  const Eigen::Vector3d a = random.direction(), b = random.direction();
  EXPECT_LT(distance(skew(a) * b, a.cross(b)), 1e-15);
}

TEST(Geometry, ExpIsTheMatrixExponential) {
  Random random;
  for (const double angle : kAngles) {
    const Vector6d d = random.tangent(5, angle);
    const Eigen::Matrix4d expected = hat(d).exp();
    EXPECT_LT(distance(expSE3(d).matrix(), expected), 1e-11) << "angle " << angle;
  }
}

TEST(Geometry, LogInvertsExpFromZeroToNearlyPi) {
  Random random;
  for (const double angle : kAngles) {
    const Vector6d d = random.tangent(5, angle);
    EXPECT_LT(distance(logSE3(expSE3(d)), d), 1e-7) << "angle " << angle;
    EXPECT_NEAR(rotationAngle(expSE3(d)), angle, 1e-7);
  }
}

TEST(Geometry, ExpInvertsLogAtAHalfTurn) {
  Random random;
  for (int i = 0; i < 20; ++i) {
    const Pose3 T = expSE3(random.tangent(5, M_PI));
    EXPECT_LT(distance(expSE3(logSE3(T)).matrix(), T.matrix()), 1e-9);
    EXPECT_NEAR(rotationAngle(T), M_PI, 1e-9);
  }
}

TEST(Geometry, LogTakesTheShortWayRound) {
  Random random;
  const Vector6d d = random.tangent(5, 2 * M_PI - 0.5);
  EXPECT_NEAR(logSE3(expSE3(d)).tail<3>().norm(), 0.5, 1e-12);
  EXPECT_TRUE(logSE3(Pose3::Identity()).isZero());
}

TEST(Geometry, AdjointMovesAPerturbationAcross) {
  Random random;
  for (int i = 0; i < 10; ++i) {
    const Pose3 T = random.pose();
    const Vector6d d = random.tangent(1, 0.7);
    EXPECT_LT(distance((T * expSE3(d)).matrix(), (expSE3(adjoint(T) * d) * T).matrix()), 1e-12);
  }
}

TEST(Geometry, RightJacobianInverseMatchesFiniteDifferences) {
  Random random;
  // 0.05 is where the series of the translation block ends.
  for (const double angle : {0.0, 1e-6, 1e-3, 0.049, 0.051, 0.5, 1.5, 3.0}) {
    const Pose3 T = expSE3(random.tangent(5, angle));
    const Vector6d log = logSE3(T);
    const Matrix6d expected =
        numericalJacobian([&](const Vector6d& d) -> Vector6d { return logSE3(T * expSE3(d)); });
    EXPECT_LT(distance(rightJacobianInverse(log), expected), 2e-8) << "angle " << angle;
  }
}

TEST(Geometry, ComposedCovarianceIsThatOfTheLinearisation) {
  Random random;
  const Pose3 a = random.pose(), b = random.pose();
  const Matrix6d cov_a = random.covariance(), cov_b = random.covariance();
  const auto error = [&](const Vector6d& da, const Vector6d& db) -> Vector6d {
    return logSE3((a * b).inverse() * (a * expSE3(da) * b * expSE3(db)));
  };
  const Matrix6d Ja =
      numericalJacobian([&](const Vector6d& d) { return error(d, Vector6d::Zero()); });
  const Matrix6d Jb =
      numericalJacobian([&](const Vector6d& d) { return error(Vector6d::Zero(), d); });
  const Matrix6d expected = Ja * cov_a * Ja.transpose() + Jb * cov_b * Jb.transpose();
  const Matrix6d actual = composeCovariance(cov_a, b, cov_b);
  EXPECT_LT(distance(actual, expected), 1e-7 * expected.cwiseAbs().maxCoeff());
  EXPECT_TRUE(isCovariance(actual));
}

TEST(Geometry, InterpolationHitsTheEndsAndKeepsAConstantTwist) {
  Random random;
  const Pose3 a = random.pose(), b = a * expSE3(random.tangent(3, 2.0));
  EXPECT_LT(distance(interpolate(a, b, 0).matrix(), a.matrix()), 1e-12);
  EXPECT_LT(distance(interpolate(a, b, 1).matrix(), b.matrix()), 1e-12);
  const Pose3 third = interpolate(a, b, 1.0 / 3.0);
  const Pose3 step = a.inverse() * third;
  EXPECT_LT(distance((a * step * step * step).matrix(), b.matrix()), 1e-12);
}

TEST(Geometry, InterpolatesAQuarterCircle) {
  // From the origin heading along x to (1, 1) heading along y: the circle about (0, 1).
  const Pose3 half = interpolate(planarPose(0, 0, 0), planarPose(1, 1, M_PI / 2), 0.5);
  const Pose3 expected = planarPose(std::sin(M_PI / 4), 1 - std::cos(M_PI / 4), M_PI / 4);
  EXPECT_LT(distance(half.matrix(), expected.matrix()), 1e-12);
}

TEST(Geometry, YawPitchRollIsThatOfMrpt) {
  Random random;
  for (int i = 0; i < 20; ++i) {
    const Pose3 T = random.uprightPose();
    const Vector6d v = yawPitchRollFromPose(T);
    const mrpt::poses::CPose3D theirs(v[0], v[1], v[2], v[3], v[4], v[5]);
    EXPECT_LT(distance(T.matrix(), matrixOf(theirs)), 1e-12);
    EXPECT_LT(distance(poseFromYawPitchRoll(v).matrix(), T.matrix()), 1e-12);
    EXPECT_NEAR(v[3], theirs.yaw(), 1e-12);
    EXPECT_NEAR(v[4], theirs.pitch(), 1e-12);
    EXPECT_NEAR(v[5], theirs.roll(), 1e-12);
    EXPECT_NEAR(yawOf(T), theirs.yaw(), 1e-12);
  }
}

TEST(Geometry, ProjectionDropsHeightRollAndPitch) {
  Vector6d v;
  v << 1, 2, 3, 0.4, 0.5, 0.6;
  const Pose3 flat = projectToPlane(poseFromYawPitchRoll(v));
  EXPECT_LT(distance(flat.matrix(), planarPose(1, 2, 0.4).matrix()), 1e-12);
}

TEST(Geometry, NormalizedRepairsADriftedRotation) {
  Random random;
  const Pose3 T = random.pose();
  Pose3 drifted = T;
  drifted.linear() *= 1.0 + 1e-6;
  drifted.linear()(0, 1) += 1e-7;
  const Pose3 repaired = normalized(drifted);
  EXPECT_LT(
      distance(repaired.linear() * repaired.linear().transpose(), Eigen::Matrix3d::Identity()),
      1e-14);
  EXPECT_LT(distance(repaired.matrix(), T.matrix()), 1e-6);
}

TEST(Geometry, RefusesWhatIsNoPoseOrCovariance) {
  const double kNan = std::numeric_limits<double>::quiet_NaN();
  Pose3 T = Pose3::Identity();
  EXPECT_TRUE(isFinite(T));
  T.translation().x() = kNan;
  EXPECT_FALSE(isFinite(T));

  EXPECT_TRUE(isCovariance(Random().covariance()));
  EXPECT_FALSE(isCovariance(Matrix6d::Zero()));
  EXPECT_FALSE(isCovariance(-Matrix6d::Identity()));
  Matrix6d m = Matrix6d::Identity();
  m(0, 1) = 0.5;
  EXPECT_FALSE(isCovariance(m)) << "not symmetric";
  m(0, 1) = m(1, 0) = 2;
  EXPECT_FALSE(isCovariance(m)) << "indefinite";
  m(0, 1) = m(1, 0) = kNan;
  EXPECT_FALSE(isCovariance(m));
}

}  // namespace
}  // namespace lamp
