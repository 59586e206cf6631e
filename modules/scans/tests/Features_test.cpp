#include "lamp/scans/Features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestRooms.h"
#include "lamp/core/Geometry.h"

namespace lamp {
namespace {

using Eigen::Vector3f;

Features featuresOf(std::vector<Vector3f> points) {
  return computeFeatures(cloudSeenFromOrigin(std::move(points)), {});
}

void expectUnitLength(const Features& features) {
  ASSERT_EQ(features.descriptors.cols(), static_cast<Eigen::Index>(features.size()));
  ASSERT_EQ(features.normals.size(), features.size());
  for (size_t i = 0; i < features.size(); ++i) {
    EXPECT_NEAR(features.descriptors.col(static_cast<Eigen::Index>(i)).norm(), 1, 1e-4);
    EXPECT_NEAR(features.normals[i].norm(), 1, 1e-4);
  }
}

/** Mean similarity of the descriptors of the keypoints that lie within 0.3 m of each other. */
double likeness(const Features& a, const Features& b, const Eigen::Isometry3f& a_T_b) {
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < a.size(); ++i)
    for (size_t j = 0; j < b.size(); ++j) {
      if ((a.points[i] - a_T_b * b.points[j]).norm() > 0.3f) continue;
      sum += a.descriptors.col(static_cast<Eigen::Index>(i))
                 .dot(b.descriptors.col(static_cast<Eigen::Index>(j)));
      ++count;
    }
  EXPECT_GT(count, 50);
  return sum / count;
}

/** Mean similarity of all pairs: what chance gives. */
double likenessByChance(const Features& a, const Features& b) {
  return (a.descriptors.transpose() * b.descriptors).mean();
}

TEST(ComputeFeatures, AreLittleChangedByARigidMotion) {
  const Features here = featuresOf(roomPoints(6000, 0.01f, 1));
  const Pose3 motion = planarPose(0.37, -0.21, 0.6);
  const Eigen::Isometry3f there_T_here = motion.cast<float>();
  Cloud cloud = cloudSeenFromOrigin(roomPoints(6000, 0.01f, 1));
  for (auto& p : cloud.points) p = there_T_here * p;
  cloud.viewpoints[0] = there_T_here.translation();
  const Features there = computeFeatures(cloud, {});
  const double right = likeness(there, here, there_T_here), chance = likenessByChance(there, here);
  EXPECT_GT(right, 0.9);
  EXPECT_LT(1 - right, 0.5 * (1 - chance));
}

TEST(ComputeFeatures, DependLittleOnHowDenselyASurfaceWasSampled) {
  const Features dense = featuresOf(roomPoints(30000, 0.01f, 1));
  const Features sparse = featuresOf(roomPoints(3000, 0.01f, 2));
  const double right = likeness(dense, sparse, Eigen::Isometry3f::Identity());
  EXPECT_GT(right, 0.9);
  EXPECT_LT(1 - right, 0.5 * (1 - likenessByChance(dense, sparse)));
}

TEST(ComputeFeatures, KeepsTheMostDistinctiveKeypoints) {
  FeatureOptions options;
  options.max_keypoints = 50;
  const Cloud cloud = cloudSeenFromOrigin(roomPoints(6000, 0.01f, 1));
  const Features few = computeFeatures(cloud, options), all = computeFeatures(cloud, {});
  EXPECT_EQ(few.size(), 50u);
  EXPECT_GT(all.size(), 50u);
  EXPECT_LE(all.size(), 1000u);
  expectUnitLength(few);
  const Eigen::VectorXf mean = all.descriptors.rowwise().mean();
  EXPECT_LT((few.descriptors.transpose() * mean).maxCoeff(),
            (all.descriptors.transpose() * mean).maxCoeff());
}

TEST(ComputeFeatures, OfPointsWithoutASurfaceAreNone) {
  EXPECT_EQ(featuresOf({}).size(), 0u);
  EXPECT_EQ(featuresOf({{1, 0, 0}}).size(), 0u);
  EXPECT_EQ(featuresOf(std::vector<Vector3f>(100, Vector3f(1, 2, 3))).size(), 0u);
  std::vector<Vector3f> line;
  for (int i = 0; i < 100; ++i) line.emplace_back(0.1f * i, 0.0f, 0.0f);
  EXPECT_EQ(featuresOf(line).size(), 0u);
}

TEST(ComputeFeatures, OfThreePointsAndAPlaneAreFinite) {
  expectUnitLength(featuresOf({{3, 0, 0}, {3, 1, 0}, {3, 0, 1}}));
  std::vector<Vector3f> plane;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) plane.emplace_back(0.2f * i, 0.2f * j, -1.0f);
  const Features features = featuresOf(plane);
  EXPECT_GT(features.size(), 100u);
  expectUnitLength(features);
}

TEST(ComputeFeatures, OfMeansThatAlmostCoincideAreFinite) {
  auto points = roomPoints(3000, 0.01f, 1);
  points.emplace_back(1e-21f, 1.0f, 1.0f);
  points.emplace_back(-1e-21f, 1.0f, 1.0f);
  expectUnitLength(featuresOf(points));
}

TEST(ComputeFeatures, TenKilometresFromTheOrigin) {
  const Vector3f offset(9999, -9999, 99);
  Cloud cloud = cloudSeenFromOrigin(roomPoints(6000, 0.01f, 1));
  const Features here = computeFeatures(cloud, {});
  for (auto& p : cloud.points) p += offset;
  cloud.viewpoints[0] = offset;
  const Features there = computeFeatures(cloud, {});
  expectUnitLength(there);
  Eigen::Isometry3f there_T_here = Eigen::Isometry3f::Identity();
  there_T_here.translation() = offset;
  EXPECT_GT(likeness(there, here, there_T_here), 0.9);
}

}  // namespace
}  // namespace lamp
