#include "lamp/scans/GlobalAlignment.h"

#include <gtest/gtest.h>

#include <random>

namespace lamp {
namespace {

using Eigen::Vector3f;

/** A hall of 30 x 20 x 6 m with boxes of all sizes, which look different from everywhere. */
Cloud hall(const Pose3& sensor, unsigned layout, unsigned seed) {
  std::mt19937 design(layout), random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> noise(0.0f, 0.01f);
  std::vector<Eigen::AlignedBox3f> boxes = {{Vector3f(-15, -10, 0), Vector3f(15, 10, 6)}};
  for (int k = 0; k < 14; ++k) {
    const float x = -14 + 24 * unit(design), y = -9 + 15 * unit(design);
    const Vector3f size(1 + 3 * unit(design), 1 + 3 * unit(design), 0.5f + 4 * unit(design));
    boxes.emplace_back(Vector3f(x, y, 0), Vector3f(x, y, 0) + size);
  }
  const Eigen::Isometry3f sensor_T_hall = sensor.inverse().cast<float>();
  std::vector<Vector3f> points;
  for (int i = 0; i < 12000; ++i) {
    const auto& box = boxes[i % 3 == 0 ? 0 : 1 + static_cast<size_t>(i) % (boxes.size() - 1)];
    Vector3f p =
        box.min() + box.sizes().cwiseProduct(Vector3f(unit(random), unit(random), unit(random)));
    const Eigen::Index axis = static_cast<Eigen::Index>(3 * unit(random)) % 3;
    p[axis] = unit(random) < 0.5f ? box.min()[axis] : box.max()[axis];
    points.push_back(sensor_T_hall * p + Vector3f(noise(random), noise(random), noise(random)));
  }
  return cloudSeenFromOrigin(std::move(points));
}

Features hallFeatures(const Pose3& sensor, unsigned layout, unsigned seed) {
  return computeFeatures(hall(sensor, layout, seed), {});
}

Pose3 sensorAt(double x, double y, double yaw) {
  Pose3 pose = planarPose(x, y, yaw);
  pose.translation().z() = 1.5;
  return pose;
}

void expectNear(const Pose3& found, const Pose3& truth) {
  const Pose3 error = truth.inverse() * found;
  EXPECT_LT(error.translation().norm(), 0.6);
  EXPECT_LT(rotationAngle(error), 4 * M_PI / 180);
}

class AlignByConsistency : public testing::TestWithParam<bool> {
 protected:
  ConsistencyOptions options() const {
    ConsistencyOptions options;
    options.upright = GetParam();
    return options;
  }
};
INSTANTIATE_TEST_SUITE_P(FreeAndUpright, AlignByConsistency, testing::Bool());

TEST_P(AlignByConsistency, FindsThePoseAtAnyYaw) {
  const Pose3 at_target = sensorAt(1, 0, 0.3);
  const Features target = hallFeatures(at_target, 1, 1);
  for (int k = 0; k < 6; ++k) {
    const Pose3 at_source = sensorAt(-2, 1, 0.2 + k * M_PI / 3);
    const auto poses =
        alignByConsistency(hallFeatures(at_source, 1, 2), target, std::nullopt, options());
    ASSERT_FALSE(poses.empty()) << k;
    expectNear(poses.front().target_T_source, at_target.inverse() * at_source);
    EXPECT_GT(poses.front().inlier_ratio, 0);
    EXPECT_LE(poses.front().inlier_ratio, 1);
    for (size_t i = 1; i < poses.size(); ++i) EXPECT_LE(poses[i].inliers, poses[i - 1].inliers);
    if (GetParam()) {
      EXPECT_NEAR(poses.front().target_T_source.linear()(2, 2), 1, 1e-12);
    }
  }
}

TEST_P(AlignByConsistency, BothDirectionsAgreeAndRunsDoNotDiffer) {
  const Features a = hallFeatures(sensorAt(1, 0, 0.3), 1, 1);
  const Features b = hallFeatures(sensorAt(-2, 1, 2), 1, 2);
  const auto forth = alignByConsistency(b, a, std::nullopt, options()),
             back = alignByConsistency(a, b, std::nullopt, options());
  ASSERT_TRUE(!forth.empty() && !back.empty());
  expectNear(back.front().target_T_source, forth.front().target_T_source.inverse());
  const auto again = alignByConsistency(b, a, std::nullopt, options());
  ASSERT_EQ(again.size(), forth.size());
  for (size_t i = 0; i < again.size(); ++i)
    EXPECT_EQ(again[i].target_T_source.matrix(), forth[i].target_T_source.matrix());
}

TEST_P(AlignByConsistency, UnrelatedCloudsAgreeOnLittle) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(-8, 8);
  std::vector<Vector3f> points;
  for (int i = 0; i < 4000; ++i)
    points.emplace_back(anywhere(random), anywhere(random), anywhere(random));
  const Features noise = computeFeatures(cloudSeenFromOrigin(points), {});
  const Features target = hallFeatures(sensorAt(1, 0, 0), 1, 1);
  const auto right =
      alignByConsistency(hallFeatures(sensorAt(0, 1, 1), 1, 2), target, std::nullopt, options());
  ASSERT_FALSE(right.empty());
  for (const GlobalPose& pose : alignByConsistency(noise, target, std::nullopt, options()))
    EXPECT_LT(pose.inliers, right.front().inliers / 3);
}

TEST_P(AlignByConsistency, RefusesWithTooFewInliers) {
  const Features a = hallFeatures(sensorAt(1, 0, 0), 1, 1), none = computeFeatures({}, {});
  const Features b = hallFeatures(sensorAt(0, 1, 1), 1, 2);
  EXPECT_TRUE(alignByConsistency(a, none, std::nullopt, options()).empty());
  EXPECT_TRUE(alignByConsistency(none, a, std::nullopt, options()).empty());
  EXPECT_TRUE(alignByConsistency(none, none, std::nullopt, options()).empty());
  ConsistencyOptions strict = options();
  strict.min_inliers = 100000;
  EXPECT_TRUE(alignByConsistency(b, a, std::nullopt, strict).empty());
}

}  // namespace
}  // namespace lamp
