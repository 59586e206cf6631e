#include "FrontEndTeam.h"

#include <gtest/gtest.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include "TestTeam.h"

namespace lamp {
namespace {

using namespace test;

/** Keeps what is sent, up to a limit. */
class Mailbox : public MessageSender {
 public:
  bool send(Message message) override {
    if (messages.size() == limit) return false;
    messages.push_back(std::move(message));
    return true;
  }
  size_t limit = 1000;
  std::vector<Message> messages;
};

InputObservation wrapped(RobotId robot, double stamp, const mrpt::obs::CObservation::Ptr& o) {
  o->timestamp = mrpt::Clock::fromDouble(stamp);
  return {robot, "sensor", stamp, o};
}

InputObservation wheels(RobotId robot, double stamp) {
  return wrapped(robot, stamp, mrpt::obs::CObservationOdometry::Create());
}

InputObservation cloud(RobotId robot, double stamp) {
  auto map = mrpt::maps::CSimplePointsMap::Create();
  map->insertPoint(1.0f, 2.0f, 3.0f);
  auto observation = mrpt::obs::CObservationPointCloud::Create();
  observation->pointcloud = map;
  return wrapped(robot, stamp, observation);
}

TEST(FrontEndTeam, TheFirstRobotWithAStartPoseTiesTheTeam) {
  const SlamConfig config = configFrom(
      "[robot.A]\n[robot.B]\nstart_pose = [1 0 0 0 0 0]\n[robot.C]\nstart_pose = [2 0 0 0 0 0]\n");
  Mailbox mailbox;
  FrontEndTeam team(config, mailbox);
  for (uint16_t r = 0; r < 4; ++r) {  // the fourth one is not in the ini
    EXPECT_TRUE(team.observe(wheels({r}, 100 + r)));
    EXPECT_TRUE(team.observe(cloud({r}, 100 + r)));
  }
  team.finish();
  ASSERT_EQ(mailbox.messages.size(), 8u) << "a key node and an end of each robot";
  const auto prior = [&](size_t i) {
    return std::get<KeyNodePacket>(mailbox.messages[2 * i]).prior;
  };
  EXPECT_FALSE(prior(0));
  EXPECT_FALSE(prior(3));
  ASSERT_TRUE(prior(1) && prior(2));
  EXPECT_LT(prior(1)->covariance(0, 0), 1e-4);
  EXPECT_NEAR(prior(2)->covariance(0, 0), 0.25, 1e-12);
  EXPECT_NEAR(prior(2)->world_T_base.translation().x(), 2, 1e-12);
}

TEST(FrontEndTeam, ARobotAtTheGateWaitsForItsPose) {
  const SlamConfig config = configFrom(
      "[gate]\nplates = [4 1.3 1.5 4 -1.3 0.9 4 0.3 1.95]\n"
      "[robot.A]\ncalibration = gate\nstart_pose = [1 0 0 0 0 0]\n");
  Mailbox mailbox;
  FrontEndTeam team(config, mailbox);
  team.observe(wheels(kA, 100));
  team.observe(cloud(kA, 100));
  EXPECT_TRUE(mailbox.messages.empty());
  team.finish();
  ASSERT_EQ(mailbox.messages.size(), 2u);
  EXPECT_TRUE(std::get<KeyNodePacket>(mailbox.messages[0]).prior)
      << "start_pose, as there is no gate";
  ASSERT_EQ(team.reports().at(0).warnings.size(), 1u);
  EXPECT_NE(team.reports()[0].warnings[0].find("gate"), std::string::npos);
}

TEST(FrontEndTeam, ClosesEachRobotsStream) {
  const SlamConfig config = configFrom("");
  Mailbox mailbox;
  FrontEndTeam team(config, mailbox);
  for (const RobotId robot : {kB, kA}) {
    team.observe(wheels(robot, 100));
    team.observe(cloud(robot, 100));
  }
  team.finish();
  ASSERT_EQ(mailbox.messages.size(), 4u);
  EXPECT_EQ(std::get<RobotEnd>(mailbox.messages[1]).robot, kA);
  EXPECT_EQ(std::get<RobotEnd>(mailbox.messages[3]).robot, kB);
  const auto reports = team.reports();
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].robot, kA);
  EXPECT_EQ(reports[1].counts.key_nodes, 1u);
}

TEST(FrontEndTeam, KeyNodesOfKeyedInputComeInTheRecordedOrder) {
  const SlamConfig config = configFrom("[frontend]\nkeyed = true\n");
  Mailbox mailbox;
  FrontEndTeam team(config, mailbox);
  for (const auto& [robot, stamp] : {std::pair{kA, 100.0}, {kB, 100.0}, {kB, 101.0}, {kB, 102.0}}) {
    team.observe(cloud(robot, stamp));
    team.observe(wheels(robot, stamp));
  }
  team.finish();  // A has said nothing since 100
  ASSERT_EQ(mailbox.messages.size(), 6u);
  const auto id = [&](size_t i) { return std::get<KeyNodePacket>(mailbox.messages[i]).id; };
  EXPECT_EQ(id(0), (KeyNodeId{kA, 0}));
  EXPECT_EQ(id(1), (KeyNodeId{kB, 0}));
  EXPECT_EQ(id(2), (KeyNodeId{kB, 1}));
}

TEST(FrontEndTeam, StopsWhenNobodyReceives) {
  const SlamConfig config = configFrom("");
  Mailbox mailbox;
  mailbox.limit = 0;
  FrontEndTeam team(config, mailbox);
  bool received = true;
  for (int i = 0; i < 10 && received; ++i) {
    team.observe(wheels(kA, 100 + i));
    received = team.observe(cloud(kA, 100 + i));
  }
  EXPECT_FALSE(received);
}

}  // namespace
}  // namespace lamp
