#include "lamp/registration/PreparedScanStore.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;
using Key = PreparedScanStore::Key;

constexpr RobotId kA{0}, kB{1};
constexpr double kSpacing = 2.0;

/** A key node that drives along x; its scan has `index + 1` points, the first one at its origin. */
KeyframePacket packet(RobotId robot, uint32_t index) {
  auto scan = std::make_shared<Scan>();
  for (uint32_t i = 0; i <= index; ++i)
    scan->points.emplace_back(0.0f, static_cast<float>(i), 0.0f);
  scan->sensor.assign(scan->points.size(), 0);
  scan->sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
  KeyframePacket packet;
  packet.id = {robot, index};
  packet.odom_T_base = planarPose(kSpacing * index, 0, 0);
  packet.scan = scan;
  return packet;
}

PreparedScanStore storeWith(uint32_t key_nodes, int neighbors = 2) {
  PreparationOptions options;
  options.accumulate_neighbors = neighbors;
  PreparedScanStore store(options);
  for (uint32_t i = 0; i < key_nodes; ++i) store.add(packet(kA, i));
  return store;
}

LoopClosureCandidate pair(KeyframeId from, KeyframeId to) {
  return {from, to, "Test", 0};
}

/** Where along x the scans lie that a cloud is made of, in its own frame. */
std::vector<float> origins(const PreparedScan& scan) {
  std::vector<float> xs;
  for (const auto& p : scan.points)
    if (p.y() == 0.0f) xs.push_back(p.x());
  return xs;
}

TEST(PreparedScanStore, SourceIsOneScan) {
  const PreparedScanStore store = storeWith(9);
  const auto source = store.prepare(store.source(pair({kA, 0}, {kA, 5})));
  EXPECT_EQ(source->size(), 6u);
  EXPECT_THAT(origins(*source), ElementsAre(0.0f));
}

TEST(PreparedScanStore, TargetIsAccumulatedByOdometry) {
  const PreparedScanStore store = storeWith(20);
  const auto target = store.prepare(store.target(pair({kA, 4}, {kA, 18})));
  EXPECT_EQ(target->size(), 3u + 4u + 5u + 6u + 7u);
  EXPECT_THAT(origins(*target), ElementsAre(-4.0f, -2.0f, 0.0f, 2.0f, 4.0f));
}

TEST(PreparedScanStore, TargetTurnsWithItsKeyNode) {
  PreparedScanStore store{PreparationOptions{}};
  KeyframePacket first = packet(kA, 0), second = packet(kA, 1);
  first.odom_T_base = planarPose(0, 0, 0);
  second.odom_T_base = planarPose(2, 0, M_PI / 2);
  store.add(first);
  store.add(second);
  const auto target = store.prepare({{kA, 1}, 1, 0});
  // The first scan's only point, its origin, lies 2 m behind, which is left of where node 1 looks.
  EXPECT_TRUE(target->points.front().isApprox(Eigen::Vector3f(0, 2, 0), 1e-6f))
      << target->points.front().transpose();
}

TEST(PreparedScanStore, TargetNeverHoldsItsOwnSource) {
  const PreparedScanStore store = storeWith(12);
  for (const uint32_t gap : {1u, 2u, 3u, 4u}) {
    const Key key = store.target(pair({kA, 5}, {kA, 5 + gap}));
    EXPECT_EQ(key.before, 2u);
    EXPECT_EQ(key.after, std::min(gap - 1, 2u)) << gap;
    EXPECT_THAT(origins(*store.prepare(key)), testing::Not(testing::Contains(kSpacing * gap)));
  }
}

TEST(PreparedScanStore, AnotherRobotsIndexDoesNotLimitTheTarget) {
  const PreparedScanStore store = storeWith(12);
  for (const uint32_t index : {4u, 5u, 6u, 7u}) {
    const Key key = store.target(pair({kA, 5}, {kB, index}));
    EXPECT_EQ(key.before, 2u);
    EXPECT_EQ(key.after, 2u);
  }
}

TEST(PreparedScanStore, TargetsAtTheEndsTakeWhatThereIs) {
  const PreparedScanStore store = storeWith(12);
  EXPECT_THAT(origins(*store.prepare(store.target(pair({kA, 0}, {kB, 0})))),
              ElementsAre(0.0f, 2.0f, 4.0f));
  EXPECT_THAT(origins(*store.prepare(store.target(pair({kA, 11}, {kB, 0})))),
              ElementsAre(-4.0f, -2.0f, 0.0f));
}

TEST(PreparedScanStore, WithoutNeighborsATargetIsOneScan) {
  const PreparedScanStore store = storeWith(12, 0);
  EXPECT_THAT(origins(*store.prepare(store.target(pair({kA, 5}, {kA, 11})))), ElementsAre(0.0f));
}

TEST(PreparedScanStore, MissingIsSortedAndDistinct) {
  const PreparedScanStore store = storeWith(12);
  const Key a{{kA, 1}, 0, 0}, b{{kA, 1}, 2, 2}, c{{kA, 7}, 0, 0};
  EXPECT_THAT(store.missing({c, b, a, c, a, b}), ElementsAre(a, b, c));
  EXPECT_THAT(store.missing({}), IsEmpty());
}

TEST(PreparedScanStore, WhatIsInsertedIsNotMissing) {
  PreparedScanStore store = storeWith(12);
  const Key done{{kA, 5}, 2, 2}, open{{kA, 5}, 0, 0};
  const auto prepared = store.prepare(done);
  store.insert(done, prepared);
  EXPECT_THAT(store.missing({done, open}), ElementsAre(open));
  EXPECT_EQ(store.get(done), prepared);
  EXPECT_THROW(store.get(open), std::out_of_range);
}

TEST(PreparedScanStore, IsMissingAgainWhenANeighborArrives) {
  PreparedScanStore store = storeWith(6);
  const Key target{{kA, 4}, 2, 2}, source{{kA, 4}, 0, 0};
  for (const Key& key : {target, source}) store.insert(key, store.prepare(key));
  EXPECT_THAT(store.missing({target, source}), IsEmpty());
  store.add(packet(kB, 6));
  EXPECT_THAT(store.missing({target}), IsEmpty()) << "another robot's key node is no neighbour";
  store.add(packet(kA, 6));
  EXPECT_THAT(store.missing({target, source}), ElementsAre(target));
  store.insert(target, store.prepare(target));
  store.add(packet(kA, 7));
  EXPECT_THAT(store.missing({target}), IsEmpty()) << "out of reach";
}

TEST(PreparedScanStore, AKeyNodeWithoutPointsIsNoProblem) {
  PreparedScanStore store{PreparationOptions{}};
  KeyframePacket empty = packet(kA, 0);
  empty.scan = std::make_shared<Scan>();
  store.add(empty);
  EXPECT_EQ(store.prepare({{kA, 0}, 0, 0})->size(), 0u);
  EXPECT_THROW(store.prepare({{kA, 3}, 0, 0}), std::out_of_range);
}

TEST(PreparedScanStore, KeepsThePlane) {
  PreparedScanStore store{PreparationOptions{}};
  KeyframePacket planar = packet(kA, 0);
  planar.planar = true;
  store.add(planar);
  store.add(packet(kA, 1));
  EXPECT_TRUE(store.prepare({{kA, 0}, 0, 0})->planar);
  EXPECT_FALSE(store.prepare({{kA, 1}, 0, 0})->planar);
}

}  // namespace
}  // namespace lamp
