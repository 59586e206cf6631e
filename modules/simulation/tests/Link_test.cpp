#include "lamp/simulation/Link.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "TestMesh.h"
#include "TestMotion.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

/** Open ground: the one wall is far behind the base. */
struct Ground {
  Mesh mesh = wallAt(1000, 1);
  RayCaster caster{mesh};
};

/** At x = 1 m/s for `half` seconds, and back. */
TrajectoryInterpolator thereAndBack(double half) {
  return motion(2 * half, [=](double t) { return planarPose(t < half ? t : 2 * half - t, 0, 0); });
}

std::vector<double> everySecond(double seconds) {
  std::vector<double> stamps;
  for (int i = 0; i <= seconds; ++i) stamps.push_back(kBegin + i);
  return stamps;
}

TEST(Link, ReachesAsFarAsItsRange) {
  const Ground ground;
  const Link link({}, ground.caster, {0, 0, 0}, {});
  EXPECT_TRUE(link.connected(kBegin, {59, 0, 0}));
  EXPECT_FALSE(link.connected(kBegin, {61, 0, 0}));
}

TEST(Link, WallsStopItButForAShortWay) {
  const Mesh mesh = wallAt(5, 50);
  const RayCaster caster(mesh);
  const Link link({}, caster, {0, 0, 0}, {});
  EXPECT_TRUE(link.connected(kBegin, {7, 0, 0}));
  EXPECT_FALSE(link.connected(kBegin, {20, 0, 0}));
}

TEST(Link, BeaconsRelayOnceTheyAreJoinedToTheBase) {
  const Ground ground;
  // The farther one lies there first, but joins only when the one between is dropped.
  const std::vector<Beacon> beacons = {{"far", {100, 0, 0}, kBegin},
                                       {"near", {50, 0, 0}, kBegin + 10},
                                       {"alone", {500, 0, 0}, kBegin}};
  const Link link({}, ground.caster, {0, 0, 0}, beacons);
  EXPECT_FALSE(link.connected(kBegin + 9, {150, 0, 0}));
  EXPECT_TRUE(link.connected(kBegin + 10, {150, 0, 0}));
  EXPECT_FALSE(link.connected(kBegin + 1000, {500, 0, 0})) << "no chain to the base";
}

TEST(Link, MessagesArriveAtOnceWhileConnected) {
  const Ground ground;
  const Link link({}, ground.caster, {0, 0, 0}, {});
  const auto stamps = everySecond(20);
  EXPECT_EQ(link.arrivalTimes(stamps, thereAndBack(10), kBegin + 100), stamps);
}

TEST(Link, ALostLinkQueuesAndThenSendsABatch) {
  const Ground ground;
  const Link link({}, ground.caster, {0, 0, 0}, {});
  const auto stamps = everySecond(200);  // out of reach from 60 s to 140 s
  const auto arrivals = link.arrivalTimes(stamps, thereAndBack(100), kBegin + 300);
  ASSERT_EQ(arrivals.size(), stamps.size());
  EXPECT_TRUE(std::is_sorted(arrivals.begin(), arrivals.end()));
  for (size_t i = 0; i < stamps.size(); ++i) EXPECT_GE(arrivals[i], stamps[i]);
  EXPECT_EQ(arrivals[50], stamps[50]);
  EXPECT_NEAR(arrivals[61] - kBegin, 140, 0.51) << "first of the batch";
  for (size_t i = 62; i < 139; ++i) EXPECT_NEAR(arrivals[i] - arrivals[i - 1], 0.2, 1e-6) << i;
  EXPECT_EQ(arrivals[190], stamps[190]) << "the queue is empty again";
}

TEST(Link, WhatNeverGotThroughArrivesWithTheRobots) {
  const Ground ground;
  const Link link({}, ground.caster, {-1000, 0, 0}, {});
  const auto stamps = everySecond(20);
  const auto arrivals = link.arrivalTimes(stamps, thereAndBack(10), kBegin + 100);
  ASSERT_EQ(arrivals.size(), stamps.size());
  for (const double arrival : arrivals) EXPECT_EQ(arrival, kBegin + 100);
}

TEST(Link, ABatchThatTheMissionCutsShortArrivesInOrder) {
  const Ground ground;
  const Link link({}, ground.caster, {0, 0, 0}, {});
  const auto arrivals = link.arrivalTimes(everySecond(200), thereAndBack(100), kBegin + 145);
  EXPECT_TRUE(std::is_sorted(arrivals.begin(), arrivals.end()));
  EXPECT_EQ(arrivals[100], kBegin + 145);
  EXPECT_EQ(arrivals[150], kBegin + 150) << "never before it was recorded";
  EXPECT_TRUE(link.arrivalTimes({}, thereAndBack(10), kBegin).empty());
}

}  // namespace
}  // namespace lamp::simulation
