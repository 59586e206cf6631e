#include "lamp/frontend/GateStart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestObservations.h"

namespace lamp {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::HasSubstr;

GateOptions gate() {
  GateOptions options;
  options.plates = {4, 1.3, 1.5, 4, -1.3, 0.9, 4, 0.3, 1.95};
  return options;
}

/** One key node. \param x_m of the robot, by odometry. */
std::vector<KeyNodePacket> packets(uint32_t index, double x_m = 0) {
  KeyNodePacket packet;
  packet.id = {kRobot, index};
  packet.odom_T_base = planarPose(x_m, 0, 0);
  return {packet};
}

InputObservation scan(double stamp) {
  return cloud(stamp, {{5, 0, 0}});
}

TEST(GateStart, KeyNodesWaitUntilTheTimeIsOver) {
  GateStart start(gate(), {});
  for (int i = 0; i < 30; ++i) {
    start.observe(scan(kStart + 0.1 * i));
    EXPECT_TRUE(start.pass(i == 0 ? packets(0) : std::vector<KeyNodePacket>()).empty());
  }
  start.observe(scan(kStart + 3.05));
  EXPECT_EQ(start.pass({}).size(), 1u);
  EXPECT_EQ(start.pass(packets(1)).size(), 1u) << "and from then on they do not";
  EXPECT_THAT(start.warnings(), ElementsAre(HasSubstr("no lidar of the robot gives intensities")));
}

TEST(GateStart, KeyNodesWaitUntilTheRobotMoves) {
  GateStart start(gate(), {});
  start.observe(wheels(kStart, 7));
  for (int i = 0; i < 10; ++i) {
    start.observe(scan(kStart + 0.1 * i));
    start.observe(wheels(kStart + 0.1 * i + 0.01, 7 + 0.001 * i));
  }
  EXPECT_TRUE(start.pass(packets(0)).empty());
  start.observe(wheels(kStart + 1.01, 7.05));
  EXPECT_EQ(start.pass({}).size(), 1u);
}

TEST(GateStart, ARobotThatNeverStandsIsRefused) {
  GateStart start(gate(), {});
  for (int i = 0; i < 5; ++i) {
    start.observe(wheels(kStart + 0.1 * i, 0.12 * i));
    start.observe(scan(kStart + 0.1 * i + 0.01));
  }
  EXPECT_EQ(start.pass(packets(0)).size(), 1u);
  EXPECT_THAT(start.warnings(), ElementsAre(HasSubstr("does not stand")));
}

TEST(GateStart, KeyNodesWaitNoLongerThanUntilOneIsElsewhere) {
  GateStart start(gate(), {});
  start.observe(scan(kStart));
  EXPECT_TRUE(start.pass(packets(0)).empty());
  EXPECT_TRUE(start.pass(packets(1, 0.01)).empty()) << "where each scan is one";
  EXPECT_EQ(start.pass(packets(2, 2)).size(), 3u);
}

TEST(GateStart, NothingIsLeftWhenARecordingEnds) {
  GateStart start(gate(), {});
  start.observe(scan(kStart));
  EXPECT_TRUE(start.pass(packets(0)).empty());
  EXPECT_EQ(start.finish().size(), 1u);
  EXPECT_EQ(start.warnings().size(), 1u);
}

}  // namespace
}  // namespace lamp
