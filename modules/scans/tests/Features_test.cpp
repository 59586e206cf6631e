#include "lamp/scans/Features.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <thread>

#include "NeighborPairs.h"
#include "TestMotions.h"
#include "TestRooms.h"
#include "lamp/scans/DescriptorMatching.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {
namespace {

using namespace test;

TEST(Features, HaveUnitLengthAndKeepToTheLimit) {
  FeatureOptions options;
  options.max_keypoints = 50;
  const Features features =
      computeFeatures(cloudSeenFromOrigin(roomPoints(4000, 0.01f, 1)), options);
  ASSERT_EQ(features.size(), 50u);
  ASSERT_EQ(features.descriptors.cols(), 50);
  for (Eigen::Index i = 0; i < features.descriptors.cols(); ++i) {
    EXPECT_NEAR(features.descriptors.col(i).norm(), 1.0f, 1e-5f);
    EXPECT_GE(features.descriptors.col(i).minCoeff(), 0.0f);
  }
}

TEST(Features, OfTheSamePlaceAreAlikeFromAnotherPose) {
  // Voxels fall differently after a motion, so descriptors are alike, not equal.
  const auto points = roomPoints(6000, 0.005f, 1);
  const Pose3 motion = expSE3(tangent(0.5, 0.3, 0, 0.05, 0.02, 1.0));
  Cloud a = cloudSeenFromOrigin(points), b = cloudSeenFromOrigin(moved(points, motion));
  a.viewpoints = {Eigen::Vector3f(0, 0, 1)};
  b.viewpoints = {motion.cast<float>() * a.viewpoints[0]};
  const Features from_a = computeFeatures(a, {}), from_b = computeFeatures(b, {});
  size_t right = 0;
  const auto matches = mutualMatches(from_a, from_b, 1, std::nullopt);
  for (const Match& match : matches)
    right +=
        (motion.cast<float>() * from_a.points[match.source] - from_b.points[match.target]).norm() <
        0.6f;
  ASSERT_GT(matches.size(), 50u);
  EXPECT_GT(right, matches.size() / 4) << "of " << matches.size();
}

TEST(Features, OfLittleAreFew) {
  for (const auto& points : std::vector<std::vector<Eigen::Vector3f>>{
           {},
           {{1, 2, 3}},
           {{0, 0, 1}, {1, 0, 1}},
           std::vector<Eigen::Vector3f>(100, Eigen::Vector3f(1, 1, 1))})
    EXPECT_EQ(computeFeatures(cloudSeenFromOrigin(points), {}).size(), 0u);
}

TEST(PreparedScan, LeavesOutWhatIsNoPoint) {
  auto points = roomPoints(500, 0.01f, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  points.emplace_back(nan, 0, 0);
  points.emplace_back(0, std::numeric_limits<float>::infinity(), 0);
  points.emplace_back(1e20f, 0, 0);
  const auto scan = prepareScan(points, 10, false);
  EXPECT_EQ(scan->size(), 500u);
  EXPECT_EQ(scan->own().size(), 500u);
  for (const auto& point : scan->points()) EXPECT_TRUE(point.allFinite());
  EXPECT_GT(scan->features().size(), 0u);
}

TEST(PreparedScan, NormalsPointTowardsTheLidar) {
  const auto scan =
      prepareScan(moved(roomPoints(2000, 0.01f, 1), expSE3(tangent(0, 0, -1, 0, 0, 0))), 10, false);
  for (size_t i = 0; i < scan->size(); ++i)
    EXPECT_LE(scan->normals()[i].dot(scan->points()[i]), 0.0f);
}

TEST(PreparedScan, ManyThreadsShareItsFeatures) {
  const auto scan = prepareScan(roomPoints(2000, 0.01f, 1), 10, false);
  std::vector<const Features*> got(4);
  std::vector<std::thread> threads;
  for (auto& place : got) threads.emplace_back([&] { place = &scan->features(); });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(std::set<const Features*>(got.begin(), got.end()).size(), 1u);
  EXPECT_GT(got[0]->size(), 0u);
}

TEST(PreparedScan, MillionsOfPointsAndPlacesFarAwayAreNoProblem) {
  EXPECT_EQ(prepareScan(roomPoints(1000000, 0.01f, 1), 6, false)->size(), 1000000u);
  const Pose3 there(Eigen::Translation3d(10000, -10000, 100));
  const auto far = prepareScan(moved(roomPoints(3000, 0.01f, 1), there), 10, false);
  EXPECT_GT(far->features().size(), 100u);
}

TEST(NeighborPairs, AreThoseOfBruteForce) {
  for (const float offset : {0.0f, -7.3f, 5000.0f}) {
    auto points = roomPoints(300, 0.01f, 2);
    for (auto& p : points) p.array() += offset;
    points.push_back(points.front());  // a twin is no neighbour
    std::set<std::pair<uint32_t, uint32_t>> expected, found;
    for (uint32_t i = 0; i < points.size(); ++i)
      for (uint32_t j = i + 1; j < points.size(); ++j) {
        const float squared = (points[i] - points[j]).squaredNorm();
        if (squared > 0 && squared <= 1.0f) expected.insert({i, j});
      }
    for (const NeighborPair& pair : neighborPairs(points, 1.0)) {
      EXPECT_TRUE(found.insert({pair.i, pair.j}).second);
      EXPECT_FLOAT_EQ(pair.squared_distance, (points[pair.i] - points[pair.j]).squaredNorm());
    }
    EXPECT_EQ(found, expected) << offset;
  }
  EXPECT_TRUE(neighborPairs({}, 1.0).empty());
}

TEST(MutualMatches, AreThoseOfBruteForce) {
  FeatureOptions options;
  options.max_keypoints = 120;
  const Features a = computeFeatures(cloudSeenFromOrigin(roomPoints(3000, 0.01f, 1)), options);
  const Features b = computeFeatures(cloudSeenFromOrigin(roomPoints(3000, 0.01f, 2)), options);
  const Eigen::MatrixXf similarity = a.descriptors.transpose() * b.descriptors;
  std::vector<Match> expected;
  for (Eigen::Index i = 0; i < similarity.rows(); ++i) {
    Eigen::Index j, back;
    similarity.row(i).maxCoeff(&j);
    similarity.col(j).maxCoeff(&back);
    if (back == i) expected.push_back({static_cast<uint32_t>(i), static_cast<uint32_t>(j)});
  }
  EXPECT_EQ(mutualMatches(a, b, 1, std::nullopt), expected);
  EXPECT_GT(mutualMatches(a, b, 3, std::nullopt).size(), expected.size());
  EXPECT_TRUE(mutualMatches({}, b, 1, std::nullopt).empty());
  EXPECT_TRUE(mutualMatches(a, {}, 1, std::nullopt).empty());
  const Whereabouts nowhere{std::vector<Eigen::Vector3f>(a.size(), Eigen::Vector3f(500, 0, 0)),
                            std::vector<float>(a.size(), 1.0f)};
  EXPECT_TRUE(mutualMatches(a, b, 1, nowhere).empty());
}

}  // namespace
}  // namespace lamp
