#include "lamp/base_station/BaseStation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <set>

#include "OneAnswer.h"
#include "TestTeam.h"
#include "lamp/base_station/LoopCounts.h"
#include "lamp/core/GraphFiles.h"

namespace lamp {
namespace {

using namespace test;

size_t loopsBetween(const PoseGraph& graph) {
  return static_cast<size_t>(
      std::count_if(graph.edges().begin(), graph.edges().end(), [](const Edge& edge) {
        return edge.type == EdgeType::kLoopClosure && edge.betweenRobots();
      }));
}

/** Largest distance of an inlier loop from the truth, metres. */
double worstInlier(const BaseStation& base, const Team& team) {
  double worst = 0;
  for (const Edge& edge : base.graph().edges()) {
    if (edge.type != EdgeType::kLoopClosure || edge.verdict != Verdict::kInlier) continue;
    const auto truth = [&](KeyNodeId id) {
      return team.drives[id.robot.value].truth[id.index].pose;
    };
    const Pose3 error = edge.from_T_to.inverse() * truth(edge.from).inverse() * truth(edge.to);
    worst = std::max(worst, error.translation().norm());
  }
  return worst;
}

class TeamOfTwo : public testing::TestWithParam<bool> {
 protected:
  const Team team{GetParam()};
};
INSTANTIATE_TEST_SUITE_P(Dimensions, TeamOfTwo, testing::Values(true, false),
                         [](const auto& dimension) {
                           return dimension.param ? "Planar" : "Spatial";
                         });

TEST_P(TeamOfTwo, ClosesLoopsAndComesNearerToTheTruthThanOdometry) {
  Station station(teamIni());
  team.sendTo(station.base);
  const BaseStation& base = station.base;
  EXPECT_EQ(base.graph().components().size(), 1u);
  EXPECT_GE(loopsBetween(base.graph()), 10u);
  EXPECT_LT(worstInlier(base, team), 0.15);
  for (const RobotId robot : {kA, kB}) {
    const RobotDrive& driven = team.drives[robot.value];
    const double before = rmse(driven.all_scans, base.tracks().odometryTrajectory(robot));
    const double after = rmse(driven.truth, keyNodeTrajectory(base.graph(), robot));
    EXPECT_GT(before, 0.5) << "the drift must be worth correcting";
    EXPECT_LT(after, 0.25) << "robot " << robot.value << ", odometry " << before;
    EXPECT_LT(rmse(driven.all_scans, base.tracks().trajectory(base.graph(), robot)), 0.3);
  }
}

TEST(BaseStation, TrajectoriesHaveOnePoseAScanAndPassThroughTheKeyNodes) {
  const Team team;
  Station station(teamIni());
  team.sendTo(station.base);
  for (const RobotId robot : {kA, kB}) {
    const RobotDrive& driven = team.drives[robot.value];
    const auto trajectory = station.base.tracks().trajectory(station.base.graph(), robot);
    ASSERT_EQ(trajectory.size(), driven.all_scans.size());
    size_t next_key = 0;
    const auto key_nodes = keyNodeTrajectory(station.base.graph(), robot);
    for (size_t i = 0; i < trajectory.size(); ++i) {
      EXPECT_EQ(trajectory[i].stamp, driven.all_scans[i].stamp);
      if (next_key == key_nodes.size() || trajectory[i].stamp != key_nodes[next_key].stamp)
        continue;
      EXPECT_EQ(trajectory[i].pose.matrix(), key_nodes[next_key].pose.matrix());
      ++next_key;
    }
    EXPECT_EQ(next_key, key_nodes.size());
    for (size_t i = 1; i < trajectory.size(); ++i) {
      const auto step = trajectory[i].pose.translation() - trajectory[i - 1].pose.translation();
      EXPECT_LT(step.norm(), 0.6) << "steps of 0.5 m must not jump, at " << i;
    }
  }
}

TEST(BaseStation, OdometryTrajectoryStartsAtTheStartPose) {
  const Team team;
  Station station(teamIni());
  team.sendTo(station.base);
  const auto& first = team.drives[kB.value].packets.front();
  EXPECT_LT((station.base.tracks().odometryTrajectory(kB).front().pose.matrix() -
             first.prior->world_T_base.matrix())
                .norm(),
            1e-9);
}

TEST(BaseStation, WithoutInterRobotLoopsThereAreNone) {
  const Team team;
  Station station(teamIni("inter_robot_loops = false\n"));
  team.sendTo(station.base);
  EXPECT_EQ(loopsBetween(station.base.graph()), 0u);
  EXPECT_GT(station.base.ledger().rows().size(), 0u);
  for (const LedgerRow& row : station.base.ledger().rows())
    EXPECT_EQ(row.candidate.from.robot, row.candidate.to.robot);
  EXPECT_EQ(station.base.graph().components().size(), 2u);
}

TEST(BaseStation, RobotsWithoutAStartPoseAreNotCompared) {
  const Team strangers(true, false);
  Station station(teamIni());
  strangers.sendTo(station.base);
  EXPECT_EQ(loopsBetween(station.base.graph()), 0u);
  EXPECT_EQ(station.base.graph().components().size(), 2u);
  // Each one's map is in the frame of its own first key node.
  for (const RobotId robot : {kA, kB}) {
    const Pose3 start = keyNodeTrajectory(station.base.graph(), robot).front().pose;
    EXPECT_LT((start.matrix() - Pose3::Identity().matrix()).norm(), 1e-6);
  }
}

TEST(BaseStation, WithoutGeneratorsOdometryIsTheMap) {
  const Team team;
  Station station("[pipeline]\ncandidates =\nexporters =\n");
  team.sendTo(station.base);
  EXPECT_EQ(station.base.candidates(), 0u);
  EXPECT_EQ(station.base.optimizations(), 0u);
  const auto odometry = station.base.tracks().odometryTrajectory(kA),
             map = station.base.tracks().trajectory(station.base.graph(), kA);
  ASSERT_EQ(odometry.size(), map.size());
  for (size_t i = 0; i < map.size(); ++i)
    EXPECT_LT((odometry[i].pose.matrix() - map[i].pose.matrix()).norm(), 1e-9);
}

TEST(BaseStation, ResultsDoNotDependOnTheNumberOfThreads) {
  const Team team;
  RobotTable robots;
  robots.add("A");
  robots.add("B");
  const auto resultWith = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<size_t>(threads));
    Station station(teamIni());
    tbb::task_arena(threads).execute([&] { team.sendTo(station.base); });
    return toG2o(station.base.graph()) +
           station.base.ledger().loops(station.base.graph(), robots).text() +
           station.base.ledger().verdicts().text();
  };
  const std::string with_one = resultWith(1);
  EXPECT_THAT(with_one, testing::HasSubstr("inlier"));
  EXPECT_EQ(with_one, resultWith(2));
}

using Pairs = std::set<std::pair<KeyNodeId, KeyNodeId>>;

Pairs pairs(const BaseStation& base) {
  Pairs result;
  for (const LedgerRow& row : base.ledger().rows())
    result.insert({row.candidate.from, row.candidate.to});
  return result;
}

/** A refiner that refuses everything leaves the poses, so that all candidates are known. */
struct RefusingStation : Station {
  explicit RefusingStation(const std::string& base_station)
      : RefusingStation(configFrom(teamIni("", base_station))) {}

 private:
  explicit RefusingStation(const SlamConfig& c) : Station(c, setupOf(c)) {}
  static BaseStationSetup setupOf(const SlamConfig& c) {
    BaseStationSetup setup = c.makeBaseStationSetup();
    setup.computation = computationWith(c, std::make_shared<OneAnswer>());
    return setup;
  }
};

TEST(BaseStation, FinishDrainsTheQueue) {
  const Team team;
  RefusingStation all("closures_per_round = 0\n");
  team.sendTo(all.base);
  RefusingStation one("closures_per_round = 1\n");
  team.send(one.base);
  const size_t before = one.base.ledger().rows().size();
  EXPECT_LE(before, one.base.graph().nodes().size()) << "one for each key node at most";
  const std::atomic<bool> interrupted{false};
  one.base.finish(interrupted);
  EXPECT_GT(one.base.ledger().rows().size(), before);
  EXPECT_EQ(one.base.ledger().rows().size(), one.base.candidates());
  EXPECT_EQ(pairs(one.base), pairs(all.base));
  EXPECT_GT(pairs(all.base).size(), 50u);
}

TEST(BaseStation, FinishStopsWhenInterrupted) {
  const Team team;
  RefusingStation station("closures_per_round = 1\n");
  team.send(station.base);
  const size_t before = station.base.ledger().rows().size();
  const std::atomic<bool> interrupted{true};
  station.base.finish(interrupted);
  EXPECT_EQ(station.base.ledger().rows().size(), before);
}

TEST(BaseStation, StartsNoRegistrationOnceInterrupted) {
  const Team team;
  RefusingStation station("closures_per_round = 0\n");
  const std::atomic<bool> interrupted{true};
  for (const KeyNodePacket& packet : team.drives[0].packets)
    station.base.receive(packet, interrupted);
  EXPECT_GT(station.base.candidates(), 0u);
  EXPECT_TRUE(station.base.ledger().rows().empty());
}

TEST(BaseStation, FinishOptimizesWhatIsLeft) {
  const Team team;
  Station station(teamIni("", "optimize_min_loops = 100000\n"));
  team.send(station.base);
  EXPECT_EQ(station.base.optimizations(), 0u);
  const std::atomic<bool> interrupted{true};
  station.base.finish(interrupted);
  EXPECT_EQ(station.base.optimizations(), 1u) << "an interrupted run gives a map, too";
  for (const Edge& edge : station.base.graph().edges()) EXPECT_NE(edge.verdict, Verdict::kPending);
}

/** R.m.s. error of all key nodes, metres. */
double keyNodeError(const Team& team, const Station& station) {
  double squares = 0;
  for (const RobotDrive& of_robot : team.drives) {
    const double error = rmse(
        of_robot.truth, keyNodeTrajectory(station.base.graph(), of_robot.packets.front().id.robot));
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(team.drives.size()));
}

TEST(BaseStation, RefinementComesNearerToTheTruth) {
  const Team team(false);
  Station station(teamIni());
  team.sendTo(station.base);
  const double before = keyNodeError(team, station);
  station.base.refine([](double) { return true; });
  EXPECT_TRUE(station.base.refinement().kept);
  EXPECT_LT(keyNodeError(team, station), before);
}

TEST(BaseStation, RefinementLeavesWhatIsFrozenAndWhatFollowsOdometryAlone) {
  const Team team(false);
  Station frozen(teamIni());
  team.sendTo(frozen.base);
  OperatorAction freeze;
  freeze.kind = ActionKind::kFreeze;
  frozen.base.apply(freeze, {});
  Station without_loops("[pipeline]\ncandidates =\nexporters =\n");
  team.sendTo(without_loops.base);
  for (Station* station : {&frozen, &without_loops}) {
    station->base.refine([](double) { return true; });
    EXPECT_EQ(station->base.refinement().surfels, 0u);
    EXPECT_FALSE(station->base.refinement().kept);
  }
}

TEST(BaseStation, SurvivesFinishWithoutAnything) {
  Station station(teamIni());
  const std::atomic<bool> interrupted{false};
  station.base.finish(interrupted);
  EXPECT_TRUE(station.base.graph().nodes().empty());
  EXPECT_TRUE(station.base.tracks().trajectory(station.base.graph(), kA).empty());
}

}  // namespace
}  // namespace lamp
