#include "lamp/frontend/GateCalibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lamp {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kDegree = M_PI / 180.0;
const std::vector<Vector3d> kPlates = {{4, 1.3, 1.5}, {4, -1.3, 0.9}, {4, 0.3, 1.95}};

/** A square that reflects, upright, across the x axis. */
struct Reflector {
  Vector3d middle;
  double size_m = 0.3;
};

/** What a robot sees of reflectors before a wall. */
struct Scene {
  std::vector<Reflector> reflectors = {{kPlates[0]}, {kPlates[1]}, {kPlates[2]}};
  Pose3 world_T_base = poseFromYawPitchRoll(
      (Vector6d() << 0.1, -0.2, 0.05, 2 * kDegree, 0.5 * kDegree, -0.4 * kDegree).finished());
  double elevation_step_deg = 2;  ///< as a VLP-16

  Scan look(unsigned seed) const;
};

/** Intensity and share of the ray at which it ends. */
std::pair<float, double> cast(const std::vector<Reflector>& reflectors, const Vector3d& origin,
                              const Vector3d& ray) {
  double share = 9.0 / ray.head<2>().norm();  // the wall
  float intensity = 0.2f;
  for (const Reflector& r : reflectors) {
    const double at = (r.middle.x() - origin.x()) / ray.x();
    const Vector3d off = origin + at * ray - r.middle;
    if (at < 0 || at > share || std::max(std::abs(off.y()), std::abs(off.z())) > 0.5 * r.size_m)
      continue;
    share = at;
    intensity = 0.9f;
  }
  return {intensity, share};
}

Scan Scene::look(unsigned seed) const {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 0.02);
  const Vector3d base_p_lidar(0.1, 0, 0.8);
  Scan scan;
  scan.sensors.push_back({"top", base_p_lidar});
  const Vector3d origin = world_T_base * base_p_lidar;
  for (double e = -15; e < 15.01; e += elevation_step_deg)
    for (double a = -180; a < 180; a += 0.4) {
      const double up = e * kDegree, left = a * kDegree;
      const Vector3d ray(std::cos(up) * std::cos(left), std::cos(up) * std::sin(left),
                         std::sin(up));
      const auto [intensity, range] = cast(reflectors, origin, world_T_base.linear() * ray);
      scan.points.push_back((base_p_lidar + (range + noise(random)) * ray).cast<float>());
      scan.intensity.push_back(intensity + 0.5f * static_cast<float>(noise(random)));
      scan.sensor.push_back(0);
    }
  return scan;
}

GateOptions gateOf(const std::vector<Vector3d>& plates) {
  GateOptions options;
  for (const Vector3d& plate : plates)
    options.plates.insert(options.plates.end(), plate.data(), plate.data() + 3);
  return options;
}

GateResult calibrate(const Scene& scene, const std::vector<Vector3d>& plates = kPlates,
                     bool with_inertial = true) {
  GateCalibration calibration(gateOf(plates));
  for (unsigned i = 0; i < 20; ++i) calibration.add(scene.look(i));
  if (with_inertial)
    calibration.addForce(scene.world_T_base.linear().transpose() * Vector3d(0, 0, 9.81));
  return calibration.solve();
}

Vector6d errorOf(const GateResult& result, const Scene& scene) {
  if (!result.pose) {
    ADD_FAILURE() << result.reason;
    return Vector6d::Constant(1e3);
  }
  const Vector6d error = logSE3(scene.world_T_base.inverse() * result.pose->world_T_base);
  EXPECT_LT(error.dot(result.pose->covariance.inverse() * error), 22.5) << "chi-square, 99.9 %";
  return error;
}

TEST(GateCalibration, FindsWhereARobotStands) {
  const Scene scene;
  const Vector6d error = errorOf(calibrate(scene), scene);
  EXPECT_LT(error.head<3>().norm(), 0.03) << error.transpose();
  EXPECT_LT(error.tail<3>().norm(), 0.2 * kDegree) << error.transpose();
  EXPECT_LT(std::abs(error[5]), 0.1 * kDegree) << error.transpose();
}

TEST(GateCalibration, WithoutAnInertialUnitFewBeamsTellRollOnlyRoughly) {
  const Scene few;
  const GateResult rough = calibrate(few, kPlates, false);
  const Vector6d error = errorOf(rough, few);
  EXPECT_LT(std::abs(error[5]), 0.1 * kDegree);
  EXPECT_GT(std::sqrt(rough.pose->covariance(3, 3)), 0.3 * kDegree);

  Scene many;
  many.elevation_step_deg = 0.2;
  const Vector6d fine = errorOf(calibrate(many, kPlates, false), many);
  EXPECT_LT(fine.head<3>().norm(), 0.015) << fine.transpose();
  EXPECT_LT(fine.tail<3>().norm(), 0.3 * kDegree) << fine.transpose();
}

TEST(GateCalibration, AnInertialUnitMountedOtherwiseIsNotBelieved) {
  const Scene scene;
  GateCalibration calibration(gateOf(kPlates));
  for (unsigned i = 0; i < 20; ++i) calibration.add(scene.look(i));
  calibration.addForce({0, 3, -9.5});
  EXPECT_LT(std::abs(errorOf(calibration.solve(), scene)[5]), 0.1 * kDegree);
}

TEST(GateCalibration, OtherReflectorsDoNotMatter) {
  Scene scene;
  scene.reflectors.push_back({{5, 2.5, 1.2}});
  scene.reflectors.push_back({{6, -2, 1.0}, 0.4});
  scene.reflectors.push_back({{7, 0.5, 0.7}, 0.25});
  scene.reflectors.push_back({{5, -2.6, 1.6}, 0.9});
  EXPECT_LT(errorOf(calibrate(scene), scene).head<3>().norm(), 0.03);
}

TEST(GateCalibration, TwoPlatesAreTooFew) {
  Scene scene;
  scene.reflectors.pop_back();
  GateResult result = calibrate(scene);
  EXPECT_FALSE(result.pose);
  EXPECT_THAT(result.reason, HasSubstr("only 2 reflectors"));

  scene.reflectors.push_back({{6, 0.3, 1.6}});  // not the third one
  result = calibrate(scene);
  EXPECT_FALSE(result.pose);
  EXPECT_THAT(result.reason, HasSubstr("no three of them"));
}

TEST(GateCalibration, ReflectorsOfAnotherSizeAreNoPlates) {
  for (const double size : {0.15, 0.45, 0.8}) {
    Scene scene;
    scene.elevation_step_deg = 0.5;
    scene.reflectors[1].size_m = size;
    EXPECT_FALSE(calibrate(scene).pose) << size;
  }
}

TEST(GateCalibration, TheMirroredTriangleIsRefused) {
  Scene scene;
  for (Reflector& reflector : scene.reflectors) reflector.middle.y() *= -1;
  EXPECT_FALSE(calibrate(scene).pose);
}

TEST(GateCalibration, FromBehindAnEvenTriangleLooksTheSame) {
  const std::vector<Vector3d> even = {{4, 1.2, 0.9}, {4, -1.2, 0.9}, {4, 0, 1.6}};
  Scene scene;
  scene.reflectors = {{even[0]}, {even[1]}, {even[2]}};
  EXPECT_LT(errorOf(calibrate(scene, even), scene).head<3>().norm(), 0.03);
}

TEST(GateCalibration, AnotherTriangleLikeTheGatesIsRefused) {
  Scene scene;
  for (size_t i = 0; i < 3; ++i) scene.reflectors.push_back({kPlates[i] + Vector3d(1, 3.5, 0)});
  const GateResult result = calibrate(scene);
  EXPECT_FALSE(result.pose);
  EXPECT_THAT(result.reason, HasSubstr("two ways"));
}

TEST(GateCalibration, FromAfarThePoseIsTooUncertain) {
  const std::vector<Vector3d> small = {{4, 0.16, 1.15}, {4, -0.16, 1.05}, {4, 0, 1.4}};
  Scene scene;
  scene.elevation_step_deg = 1;
  scene.reflectors = {{small[0], 0.1}, {small[1], 0.1}, {small[2], 0.1}};
  GateOptions options = gateOf(small);
  options.plate_m = 0.1;
  GateCalibration calibration(options);
  for (unsigned i = 0; i < 20; ++i) calibration.add(scene.look(i));
  const GateResult result = calibration.solve();
  EXPECT_FALSE(result.pose) << result.pose->covariance.diagonal().cwiseSqrt().transpose();
  EXPECT_THAT(result.reason, HasSubstr("only"));
}

TEST(GateCalibration, WithoutIntensityNothingShines) {
  Scan scan = Scene().look(1);
  scan.intensity.clear();
  GateCalibration calibration(gateOf(kPlates));
  calibration.add(scan);
  EXPECT_THAT(calibration.solve().reason, HasSubstr("intensities"));
}

TEST(GateCalibration, ARobotThatMovesIsRefused) {
  Scene scene;
  GateCalibration calibration(gateOf(kPlates));
  for (unsigned i = 0; i < 20; ++i) {
    calibration.add(scene.look(i));
    scene.world_T_base.translation().y() += 0.05;
  }
  EXPECT_FALSE(calibration.solve().pose);
}

TEST(GateCalibration, PlatesThatTellNoPoseAreFaults) {
  EXPECT_FALSE(faultOf(gateOf(kPlates)));
  EXPECT_TRUE(faultOf(GateOptions()));
  EXPECT_THAT(*faultOf(gateOf({{4, -1, 1}, {4, 0, 1.1}, {4, 1, 1.2}})), HasSubstr("line"));
  EXPECT_THAT(*faultOf(gateOf({{4, -1, 1}, {4, 0, 2}, {4, 0.2, 2.4}})), HasSubstr("apart"));
}

}  // namespace
}  // namespace lamp
