#include "lamp/registration/PreparedScanStore.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::UnorderedElementsAre;
using Key = PreparedScanStore::Key;

constexpr RobotId kA{0}, kB{1};
constexpr double kSpacing = 2.0;

/** A key node that drives along x; its scan has `index + 1` points, the first one at its origin. */
KeyNodePacket packet(RobotId robot, uint32_t index) {
  auto scan = std::make_shared<Scan>();
  for (uint32_t i = 0; i <= index; ++i)
    scan->points.emplace_back(0.0f, static_cast<float>(i), 0.0f);
  scan->sensor.assign(scan->points.size(), 0);
  scan->sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
  KeyNodePacket packet;
  packet.id = {robot, index};
  packet.odom_T_base = planarPose(kSpacing * index, 0, 0);
  packet.scan = scan;
  return packet;
}

PreparationOptions withNeighbors(int neighbors) {
  PreparationOptions options;
  options.accumulate_neighbors = neighbors;
  return options;
}

/** A store with so many key nodes of robot A. */
struct StoreOf : PreparedScanStore {
  explicit StoreOf(uint32_t key_nodes, int neighbors = 2)
      : StoreOf(key_nodes, withNeighbors(neighbors)) {}
  StoreOf(uint32_t key_nodes, const PreparationOptions& options) : PreparedScanStore(options) {
    for (uint32_t i = 0; i < key_nodes; ++i) add(packet(kA, i));
  }
};

LoopClosureCandidate pair(KeyNodeId from, KeyNodeId to) {
  return {from, to, "Test", 0};
}

/** Where along x the scans lie that a cloud is made of, in its own frame. */
std::vector<float> origins(const PreparedScan& scan) {
  std::vector<float> xs;
  for (const auto& p : scan.points())
    if (p.y() == 0.0f) xs.push_back(p.x());
  return xs;
}

TEST(PreparedScanStore, AccumulatesByOdometryAndKnowsItsOwn) {
  StoreOf store(20);
  const auto target = store.get(store.target(pair({kA, 4}, {kA, 18})));
  EXPECT_EQ(target->size(), 3u + 4u + 5u + 6u + 7u);
  EXPECT_EQ(target->own().size(), 5u);
  EXPECT_THAT(origins(*target), UnorderedElementsAre(-4.0f, -2.0f, 0.0f, 2.0f, 4.0f));
  for (const uint32_t i : target->own()) EXPECT_EQ(target->points()[i].x(), 0.0f);
}

TEST(PreparedScanStore, TurnsWithItsKeyNode) {
  PreparedScanStore store{PreparationOptions{}};
  KeyNodePacket first = packet(kA, 0), second = packet(kA, 1);
  first.odom_T_base = planarPose(0, 0, 0);
  second.odom_T_base = planarPose(2, 0, M_PI / 2);
  store.add(first);
  store.add(second);
  const auto target = store.get({{kA, 1}, 1, 0});
  // The first scan's only point, its origin, lies 2 m behind, which is left of where node 1 looks.
  ASSERT_EQ(target->size(), 2u + 1u);
  const auto isNeighbors = [](const Eigen::Vector3f& p) {
    return p.isApprox(Eigen::Vector3f(0, 2, 0), 1e-6f);
  };
  EXPECT_TRUE(std::any_of(target->points().begin(), target->points().end(), isNeighbors));
}

TEST(PreparedScanStore, SourceAndTargetOfOneRobotNeverShareAScan) {
  StoreOf store(20);
  for (const uint32_t gap : {1u, 2u, 3u, 4u, 5u, 6u}) {
    const auto candidate = pair({kA, 5}, {kA, 5 + gap});
    const Key target = store.target(candidate), source = store.source(candidate);
    EXPECT_EQ(target.after, source.before);
    EXPECT_LT(5 + target.after, 5 + gap - source.before) << gap;
    EXPECT_EQ(target.after, std::min((gap - 1) / 2, 2u)) << gap;
  }
}

TEST(PreparedScanStore, AnotherRobotsIndexDoesNotLimitTheNeighbors) {
  StoreOf store(12);
  for (const uint32_t index : {4u, 5u, 6u, 7u}) {
    const Key key = store.target(pair({kA, 5}, {kB, index}));
    EXPECT_EQ(key.before, 2u);
    EXPECT_EQ(key.after, 2u);
  }
}

TEST(PreparedScanStore, TheEndsTakeWhatThereIs) {
  StoreOf store(12);
  EXPECT_THAT(origins(*store.get(store.target(pair({kA, 0}, {kB, 0})))),
              UnorderedElementsAre(0.0f, 2.0f, 4.0f));
  EXPECT_THAT(origins(*store.get(store.target(pair({kA, 11}, {kB, 0})))),
              UnorderedElementsAre(-4.0f, -2.0f, 0.0f));
}

TEST(PreparedScanStore, WithoutNeighborsItIsOneScan) {
  StoreOf store(12, 0);
  EXPECT_THAT(origins(*store.get(store.target(pair({kA, 5}, {kA, 11})))), ElementsAre(0.0f));
}

TEST(PreparedScanStore, PreparesOnce) {
  StoreOf store(12);
  const auto once = store.get({{kA, 5}, 2, 2});
  EXPECT_EQ(store.get({{kA, 5}, 2, 2}), once);
  EXPECT_NE(store.get({{kA, 5}, 1, 1}), once);
  EXPECT_EQ(store.report().scans, 2u);
  EXPECT_GT(store.report().seconds, 0.0);
}

TEST(PreparedScanStore, ManyThreadsGetOneAndTheSame) {
  StoreOf store(12);
  std::vector<PreparedScanPtr> got(64);
  tbb::parallel_for(size_t{0}, got.size(), [&](size_t i) {
    got[i] = store.get({{kA, static_cast<uint32_t>(i % 4)}, 2, 2});
  });
  for (size_t i = 0; i < got.size(); ++i) EXPECT_EQ(got[i], got[i % 4]);
  EXPECT_EQ(store.report().scans, 4u);
}

TEST(PreparedScanStore, PreparesAgainWhenANeighborHasArrived) {
  StoreOf store(6);
  const Key key{{kA, 4}, 2, 2}, alone{{kA, 4}, 0, 0};
  const auto before = store.get(key), alone_before = store.get(alone);
  store.add(packet(kB, 6));
  EXPECT_EQ(store.get(key), before) << "another robot's key node is no neighbour";
  store.add(packet(kA, 6));
  EXPECT_EQ(store.get(key)->size(), before->size() + 7);
  EXPECT_EQ(store.get(alone), alone_before);
  const auto now = store.get(key);
  store.add(packet(kA, 7));
  EXPECT_EQ(store.get(key), now) << "out of reach";
}

TEST(PreparedScanStore, WhatWasUsedLongAgoMakesRoom) {
  PreparationOptions options = withNeighbors(0);
  options.memory_limit_mb = 1;  // a scan's free space alone takes 74 kB: there is room for some
  StoreOf store(40, options);
  const auto first = store.get({{kA, 0}, 0, 0});
  const auto second = store.get({{kA, 1}, 0, 0});
  for (uint32_t i = 2; i < 40; ++i) {
    store.get({{kA, i}, 0, 0});
    EXPECT_EQ(store.get({{kA, 0}, 0, 0}), first) << "used all the time";
  }
  EXPECT_EQ(store.report().scans, 40u);
  EXPECT_NE(store.get({{kA, 1}, 0, 0}), second);
  EXPECT_EQ(store.report().scans, 41u) << "prepared twice";
}

TEST(PreparedScanStore, AKeyNodeWithoutPointsIsNoProblem) {
  PreparedScanStore store{PreparationOptions{}};
  KeyNodePacket empty = packet(kA, 0);
  empty.scan = std::make_shared<Scan>();
  store.add(empty);
  EXPECT_EQ(store.get({{kA, 0}, 0, 0})->size(), 0u);
  EXPECT_THROW(store.get({{kA, 3}, 0, 0}), std::out_of_range);
}

TEST(PreparedScanStore, KeepsThePlane) {
  PreparedScanStore store{PreparationOptions{}};
  KeyNodePacket planar = packet(kA, 0);
  planar.planar = true;
  store.add(planar);
  store.add(packet(kA, 1));
  EXPECT_TRUE(store.get({{kA, 0}, 0, 0})->planar());
  EXPECT_FALSE(store.get({{kA, 1}, 0, 0})->planar());
}

}  // namespace
}  // namespace lamp
