#include "lamp/scans/RegistrationInformation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;
using testing::HasSubstr;

/** Points of a surface with their normals. */
struct Surface {
  Points points, normals;
};

/** All points of a surface, matched, about the pivot. */
MatchedSurface matched(const Surface& surface,
                       const Eigen::Vector3d& pivot = Eigen::Vector3d::Zero()) {
  MatchedSurface result;
  double squares = 0;
  for (size_t i = 0; i < surface.points.size(); ++i) {
    const Eigen::Vector3d lever = surface.points[i].cast<double>();
    const Eigen::Vector3d n = surface.normals[i].cast<double>();
    Vector6d h;
    h << n, lever.cross(n);
    result.information += h * h.transpose();
    squares += lever.squaredNorm();
  }
  result.pivot = pivot;
  result.weights = static_cast<double>(surface.points.size());
  result.patches = result.weights / 10;
  result.radius_m = std::sqrt(squares / result.weights);
  result.residual_m = 0.04;
  return result;
}

/** A tunnel with a square profile, infinitely smooth, along the unit vector `axis`. */
Surface tunnel(const Eigen::Vector3f& axis) {
  const Eigen::Quaternionf R = Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitX(), axis);
  Surface surface;
  for (float x = -5; x <= 5; x += 0.5f)
    for (float s = -1.5f; s <= 1.5f; s += 0.25f)
      for (const float side : {-1.5f, 1.5f}) {
        surface.points.push_back(R * Eigen::Vector3f(x, side, s));
        surface.normals.push_back(R * Eigen::Vector3f::UnitY());
        surface.points.push_back(R * Eigen::Vector3f(x, s, side));
        surface.normals.push_back(R * Eigen::Vector3f::UnitZ());
      }
  return surface;
}

/** The tunnel with walls at both ends. */
Surface room() {
  Surface surface = tunnel(Eigen::Vector3f::UnitX());
  for (float y = -1.5f; y <= 1.5f; y += 0.25f)
    for (float z = -1.5f; z <= 1.5f; z += 0.25f)
      for (const float end : {-5.0f, 5.0f}) {
        surface.points.emplace_back(end, y, z);
        surface.normals.emplace_back(1, 0, 0);
      }
  return surface;
}

TEST(RegistrationInformation, IsTheInverseOfTheModelsCovarianceWhereAllIsObserved) {
  RegistrationInformationOptions options;
  const MatchedSurface surface = matched(room());
  const RegistrationInformation known =
      registrationInformation(surface, Pose3::Identity(), options, false);
  EXPECT_TRUE(known.unobserved.empty());
  const double variance = 0.04 * 0.04 + options.sigma_m * options.sigma_m;
  Matrix6d expected =
      variance * (surface.information * surface.patches / surface.weights).inverse();
  const double common = options.common_share * options.common_share * variance;
  expected.diagonal().head<3>().array() += common;
  expected.diagonal().tail<3>().array() += common / (surface.radius_m * surface.radius_m);
  EXPECT_LT((known.information.inverse() - expected).norm(), 1e-9 * expected.norm());
}

TEST(RegistrationInformation, BelongsToTheTangentSpaceAtThePose) {
  // Points that were at `lever` about the pivot are elsewhere in the source's frame.
  const MatchedSurface surface = matched(room(), {3, -2, 1});
  const Pose3 target_T_source = expSE3(tangent(1, 2, 0.5, 0.3, -0.2, 1.2));
  const Matrix6d information =
      registrationInformation(surface, target_T_source, {}, false).information;
  // A motion about the pivot, seen from the source: T Exp(d) = P Exp(m) P^-1 T.
  const Pose3 P = Pose3(Eigen::Translation3d(surface.pivot));
  const Matrix6d about_pivot =
      registrationInformation(matched(room()), Pose3::Identity(), {}, false).information;
  const Vector6d d = 1e-4 * tangent(1, -2, 3, 0.4, 0.5, -0.6);
  const Vector6d m =
      logSE3(P.inverse() * target_T_source * expSE3(d) * target_T_source.inverse() * P);
  const double expected = m.dot(about_pivot * m);
  EXPECT_NEAR(d.dot(information * d), expected, 1e-3 * expected);
}

TEST(RegistrationInformation, KnowsNothingAlongATunnelAndSaysSo) {
  for (const Eigen::Vector3f& axis :
       {Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 1, 0), Eigen::Vector3f(1, 2, -1)}) {
    const Eigen::Vector3d along = axis.normalized().cast<double>();
    const RegistrationInformation known =
        registrationInformation(matched(tunnel(axis.normalized())), Pose3::Identity(), {}, false);
    ASSERT_EQ(known.unobserved.size(), 1u);
    EXPECT_THAT(known.unobserved[0], HasSubstr("translation along"));
    Vector6d slide = Vector6d::Zero();
    slide.head<3>() = along;
    EXPECT_LT(slide.dot(known.information * slide), 1e-6);
    slide.head<3>() = along.unitOrthogonal();
    EXPECT_GT(slide.dot(known.information * slide), 100.0) << "the walls hold it across";
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(known.information);
    EXPECT_GT(eigen.eigenvalues()[1], 10.0) << "and nothing else is lost";
  }
}

TEST(RegistrationInformation, APlaneKnowsItsHeightAndItsTilt) {
  Surface plane;
  for (float x = -3; x <= 3; x += 0.25f)
    for (float y = -3; y <= 3; y += 0.25f) {
      plane.points.emplace_back(x, y, 0);
      plane.normals.emplace_back(0, 0, 1);
    }
  const RegistrationInformation known =
      registrationInformation(matched(plane), Pose3::Identity(), {}, false);
  EXPECT_EQ(known.unobserved.size(), 3u);
  const Vector6d diagonal = known.information.diagonal();
  for (const int axis : {0, 1, 5}) EXPECT_NEAR(diagonal[axis], 0, 1e-9);
  for (const int axis : {2, 3, 4}) EXPECT_GT(diagonal[axis], 100);
}

TEST(RegistrationInformation, InThePlaneOnlyItsOwnAxesAreMissed) {
  Surface corridor, hall;
  for (float x = -5; x <= 5; x += 0.1f)
    for (const float y : {-1.0f, 1.0f}) {
      corridor.points.emplace_back(x, y, 0);
      corridor.normals.emplace_back(0, 1, 0);
    }
  hall = corridor;
  for (float y = -1; y <= 1; y += 0.1f) {
    hall.points.emplace_back(5, y, 0);
    hall.normals.emplace_back(1, 0, 0);
  }
  const RegistrationInformation along =
      registrationInformation(matched(corridor), Pose3::Identity(), {}, true);
  ASSERT_EQ(along.unobserved.size(), 1u);
  EXPECT_THAT(along.unobserved[0], HasSubstr("translation along"));
  EXPECT_NEAR(along.information(0, 0), 0, 1e-9);
  EXPECT_GT(along.information(1, 1), 100);
  EXPECT_TRUE(
      registrationInformation(matched(hall), Pose3::Identity(), {}, true).unobserved.empty());
}

TEST(RegistrationInformation, FewerPatchesKnowLess) {
  MatchedSurface few = matched(room()), many = few;
  many.patches = 10 * few.patches;
  RegistrationInformationOptions options;
  options.common_share = 1e-9;
  const double of_few =
      registrationInformation(few, Pose3::Identity(), options, false).information(0, 0);
  const double of_many =
      registrationInformation(many, Pose3::Identity(), options, false).information(0, 0);
  EXPECT_NEAR(of_many, 10 * of_few, 1e-6 * of_many);
}

TEST(RegistrationInformation, IsNoneWithoutMatches) {
  EXPECT_TRUE(registrationInformation({}, Pose3::Identity(), {}, false).information.isZero());
  EXPECT_TRUE(registrationInformation({}, Pose3::Identity(), {}, true).information.isZero());
}

}  // namespace
}  // namespace lamp
