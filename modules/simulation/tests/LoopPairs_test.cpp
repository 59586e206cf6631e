#include "lamp/simulation/LoopPairs.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "SmallMission.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

const std::vector<LoopPair>& sharedPairs() {
  const SmallMission& small = SmallMission::shared();
  static const auto pairs = findLoopPairs(small.mission, small.world.layout, small.scans, 400, 5);
  return pairs;
}

const Scan& scanOf(KeyNodeId id) {
  return *SmallMission::shared().scans[id.robot.value][id.index];
}

Pose3 truthOf(KeyNodeId id) {
  const MissionRobot& robot = SmallMission::shared().mission.robots[id.robot.value];
  return robot.truth.at(robot.stampOf(id.index));
}

struct Surfel {
  Vector3d point, normal;
};

/** Means of the points in voxels of 0.2 m, with normals from the ten nearest of them. */
std::vector<Surfel> surfels(const Scan& scan) {
  std::map<std::array<int, 3>, std::pair<Vector3d, int>> voxels;
  for (const Eigen::Vector3f& p : scan.points) {
    const Eigen::Vector3i cell = (p / 0.2f).array().floor().cast<int>();
    auto& [sum, count] =
        voxels.try_emplace({cell.x(), cell.y(), cell.z()}, Vector3d::Zero(), 0).first->second;
    sum += p.cast<double>();
    ++count;
  }
  std::vector<Surfel> result;
  for (const auto& [cell, mean] : voxels)
    result.push_back({mean.first / mean.second, Vector3d::Zero()});
  for (Surfel& surfel : result) {
    std::vector<std::pair<double, size_t>> near;
    for (size_t i = 0; i < result.size(); ++i)
      near.emplace_back((result[i].point - surfel.point).squaredNorm(), i);
    std::partial_sort(near.begin(), near.begin() + 10, near.end());
    Vector3d middle = Vector3d::Zero();
    for (size_t i = 0; i < 10; ++i) middle += result[near[i].second].point / 10;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (size_t i = 0; i < 10; ++i) {
      const Vector3d offset = result[near[i].second].point - middle;
      spread += offset * offset.transpose();
    }
    surfel.normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors().col(0);
  }
  return result;
}

double shareWithPartner(const std::vector<Surfel>& a, const std::vector<Surfel>& b,
                        const Pose3& b_T_a) {
  int with = 0;
  for (const Surfel& surfel : a) {
    const Vector3d point = b_T_a * surfel.point, normal = b_T_a.linear() * surfel.normal;
    with += std::any_of(b.begin(), b.end(), [&](const Surfel& other) {
      return (other.point - point).norm() < 0.3 &&
             std::abs(other.normal.dot(normal)) > std::sqrt(0.5);
    });
  }
  return with / static_cast<double>(a.size());
}

double bruteForceOverlap(const LoopPair& pair) {
  const auto from = surfels(scanOf(pair.from)), to = surfels(scanOf(pair.to));
  return std::min(shareWithPartner(from, to, pair.from_T_to.inverse()),
                  shareWithPartner(to, from, pair.from_T_to));
}

TEST(LoopPairs, AreDistinctSortedAndNoNeighbours) {
  const auto& pairs = sharedPairs();
  ASSERT_GT(pairs.size(), 40u);
  for (size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_LT(pairs[i].from, pairs[i].to);
    if (pairs[i].from.robot == pairs[i].to.robot) {
      EXPECT_GE(pairs[i].to.index - pairs[i].from.index, 10u);
    }
    if (i == 0) continue;
    EXPECT_LT(std::tie(pairs[i - 1].from, pairs[i - 1].to), std::tie(pairs[i].from, pairs[i].to));
  }
}

TEST(LoopPairs, AreOfBothSortsWithinAndBetweenRobots) {
  std::set<std::pair<bool, bool>> sorts;
  for (const LoopPair& pair : sharedPairs())
    sorts.emplace(pair.same_place, pair.from.robot == pair.to.robot);
  EXPECT_EQ(sorts.size(), 4u);
}

TEST(LoopPairs, TransformsAreTrue) {
  for (const LoopPair& pair : sharedPairs()) {
    const Pose3 expected = truthOf(pair.from).inverse() * truthOf(pair.to);
    EXPECT_LT(logSE3(expected.inverse() * pair.from_T_to).norm(), 1e-9);
    EXPECT_LT(pair.from_T_to.translation().norm(), 25);
    const MissionRobot& from = SmallMission::shared().mission.robots[pair.from.robot.value];
    EXPECT_EQ(pair.from_stamp, from.stampOf(pair.from.index));
  }
}

TEST(LoopPairs, LabelsFollowTheOverlap) {
  for (const LoopPair& pair : sharedPairs()) {
    EXPECT_TRUE(pair.same_place ? pair.overlap >= 0.3 : pair.overlap < 0.05) << pair.overlap;
    EXPECT_FALSE(pair.look_alike) << "the demo world has none";
  }
}

TEST(LoopPairs, OverlapIsThatOfBruteForce) {
  const auto& pairs = sharedPairs();
  for (size_t i = 0; i < pairs.size(); i += pairs.size() / 10)
    EXPECT_NEAR(bruteForceOverlap(pairs[i]), pairs[i].overlap, 0.1) << i;
}

/** The places of the two key nodes that are farthest apart. */
std::pair<Vector3d, Vector3d> farthestSpots() {
  std::vector<Vector3d> places;
  for (const MissionRobot& robot : SmallMission::shared().mission.robots)
    for (size_t i = 0; i < robot.key_nodes.size(); ++i)
      places.push_back(robot.truth.at(robot.stampOf(i)).translation());
  std::pair<Vector3d, Vector3d> farthest{places[0], places[0]};
  for (const Vector3d& a : places)
    for (const Vector3d& b : places)
      if ((a - b).norm() > (farthest.first - farthest.second).norm()) farthest = {a, b};
  return farthest;
}

TEST(LoopPairs, FalseOnesIncludeLookAlikePlaces) {
  const SmallMission& small = SmallMission::shared();
  const auto [start, farthest] = farthestSpots();
  ASSERT_GT((farthest - start).norm(), 28) << "too near for another place";
  Layout layout = small.world.layout;
  layout.look_alikes = {{start, farthest}};
  int alike = 0;
  for (const LoopPair& pair : findLoopPairs(small.mission, layout, small.scans, 30, 5)) {
    if (!pair.look_alike) continue;
    ++alike;
    EXPECT_FALSE(pair.same_place);
    EXPECT_GT(pair.from_T_to.translation().norm(), 25);
    for (const KeyNodeId id : {pair.from, pair.to}) {
      const Vector3d at = truthOf(id).translation();
      EXPECT_LT(std::min((at - start).norm(), (at - farthest).norm()), 6);
    }
  }
  EXPECT_GE(alike, 3);
  EXPECT_LE(alike, 10) << "a third";
}

TEST(LoopPairs, AreNoMoreThanAsked) {
  const SmallMission& small = SmallMission::shared();
  const auto pairs = findLoopPairs(small.mission, small.world.layout, small.scans, 12, 5);
  const auto same = std::count_if(pairs.begin(), pairs.end(),
                                  [](const LoopPair& pair) { return pair.same_place; });
  EXPECT_EQ(same, 12);
  EXPECT_EQ(pairs.size(), 24u);
  EXPECT_TRUE(findLoopPairs(small.mission, small.world.layout, small.scans, 0, 5).empty());
}

TEST(LoopPairs, TheSeedDecidesWhichOnes) {
  const SmallMission& small = SmallMission::shared();
  const auto ends = [&](uint64_t seed) {
    std::vector<std::pair<KeyNodeId, KeyNodeId>> ids;
    for (const LoopPair& p :
         findLoopPairs(small.mission, small.world.layout, small.scans, 20, seed))
      ids.emplace_back(p.from, p.to);
    return ids;
  };
  EXPECT_EQ(ends(1), ends(1));
  EXPECT_NE(ends(1), ends(2));
}

}  // namespace
}  // namespace lamp::simulation
