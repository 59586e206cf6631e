#include "lamp/base_station/BaseStation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <set>

#include "TestTeam.h"
#include "lamp/base_station/LoopCounts.h"
#include "lamp/core/GraphFiles.h"

namespace lamp {

/** Proposes at key node k the pairs 0 - k for some k, and 0 - 2 again and again. */
class ScriptedCandidates : public CandidateGenerator {
  DEFINE_MRPT_OBJECT(ScriptedCandidates, lamp)
 public:
  void visit(OptionVisitor&) override {}
  std::vector<LoopClosureCandidate> propose(const PoseGraph&, KeyNodeId current) override {
    std::vector<LoopClosureCandidate> candidates;
    const auto add = [&](uint32_t to) {
      candidates.push_back({{current.robot, 0}, {current.robot, to}, "Scripted", 0});
    };
    if (current.index == 6 || current.index == 11) add(current.index);
    if (current.index >= 2) add(2);
    return candidates;
  }
};

/** Knows one answer, for sources of 12 points: 16 m ahead. */
class OneAnswer : public Refiner {
  DEFINE_MRPT_OBJECT(OneAnswer, lamp)
 public:
  void visit(OptionVisitor&) override {}
  RegistrationResult refine(const PreparedScan& source, const PreparedScan&,
                            const Hypothesis& hypothesis) const override {
    RegistrationResult result;
    result.target_T_source = hypothesis.target_T_source;
    if (source.own().size() != 12) return result;
    result.converged = true;
    result.target_T_source = planarPose(16, 0, 0);
    result.information = Matrix6d::Identity() / variance;
    return result;
  }
  double variance = 1e-6;
};

}  // namespace lamp

IMPLEMENTS_MRPT_OBJECT(ScriptedCandidates, lamp::CandidateGenerator, lamp)
IMPLEMENTS_MRPT_OBJECT(OneAnswer, lamp::Refiner, lamp)

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

/** The config's computation with another refiner. */
LoopClosureComputation computationWith(const SlamConfig& config,
                                       std::shared_ptr<const Refiner> refiner) {
  const auto aligners = config.make<InitialAligner>();
  const auto verifiers = config.make<Verifier>();
  return {{aligners.begin(), aligners.end()},
          std::move(refiner),
          {verifiers.begin(), verifiers.end()},
          config.registration.ambiguity};
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

/** Twelve key nodes, 2 m apart, with one scan between each two; the scan of key node k has k + 1
 * points. The loop 0 - 11 says 16 m where odometry says 22 m, so that key node k moves back by
 * about k * 6/11 m. */
class ScriptedLoops : public testing::Test {
 protected:
  void run(const std::string& options, const std::string& optimizer = "Lm",
           double loop_variance = 1e-6) {
    const SlamConfig config = configFrom("[pipeline]\noptimizer = " + optimizer +
                                         "\nverifiers =\nexporters =\n[base_station]\n" + options);
    BaseStationSetup setup = config.makeBaseStationSetup();
    setup.candidates = {std::make_shared<ScriptedCandidates>()};
    const auto refiner = std::make_shared<OneAnswer>();
    refiner->variance = loop_variance;
    setup.computation = computationWith(config, refiner);
    station_ = std::make_unique<Station>(config, std::move(setup));
    for (uint32_t k = 0; k < 12; ++k) station_->base.receive(packet(k));
    const std::atomic<bool> interrupted{false};
    station_->base.finish(interrupted);
  }

  std::vector<const LedgerRow*> attempts(uint32_t to) const {
    return station_->base.ledger().attempts({kA, 0}, {kA, to});
  }

  /** One edge turns uncertainly, so that both directions of a relative pose differ. */
  static Matrix6d edgeCovariance(uint32_t k) {
    Vector6d variances;
    variances << 0.01, 0.01, 0.01, 1e-4, 1e-4, k == 1 ? 1e-2 : 1e-4;
    return variances.asDiagonal();
  }

  static KeyNodePacket packet(uint32_t k) {
    auto scan = std::make_shared<Scan>();
    scan->points.resize(k + 1, Eigen::Vector3f::Ones());
    scan->sensor.resize(k + 1, 0);
    scan->sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
    KeyNodePacket packet;
    packet.id = {kA, k};
    packet.stamp = k;
    packet.odom_T_base = planarPose(2.0 * k, 0, 0);
    packet.scan = scan;
    if (k == 0) return packet;
    packet.odometry = OdometryEdge{planarPose(2, 0, 0), edgeCovariance(k)};
    packet.passed_scans = {{k - 0.5, planarPose(2.0 * k - 1, 0, 0)}};
    return packet;
  }

  std::unique_ptr<Station> station_;
};

const char* const kRetryFrom2m =
    "optimize_min_loops = 1\nrepropose_distance_m = 0.5\nretry_distance_m = 2\n";
const char* const kRetryFrom1m =
    "optimize_min_loops = 1\nrepropose_distance_m = 0.5\nretry_distance_m = 1\n";

TEST_F(ScriptedLoops, ARefusedPairIsTriedAgainOnlyWhenItsGuessMoved) {
  run(kRetryFrom2m);
  EXPECT_NEAR(keyNodeTrajectory(station_->base.graph(), kA)[11].pose.translation().x(), 16, 0.01);
  const auto far = attempts(6);
  ASSERT_EQ(far.size(), 2u);
  EXPECT_NEAR(far[0]->guess.target_T_source.translation().x(), 12, 1e-9);
  EXPECT_NEAR(far[1]->guess.target_T_source.translation().x(), 12 - 6 * 6.0 / 11, 0.01);
  EXPECT_EQ(far[0]->loop_id, far[1]->loop_id);
  EXPECT_EQ(far[1]->attempt, 2);
  EXPECT_EQ(far[1]->outcome.reason, "did not converge");
  EXPECT_EQ(attempts(2).size(), 1u) << "proposed ten times, but its guess moved by 1.1 m only";
  EXPECT_EQ(attempts(11).size(), 1u) << "accepted: nothing to try again";
}

TEST_F(ScriptedLoops, ThresholdAndNumberOfAttemptsAreOptions) {
  run(kRetryFrom1m);
  EXPECT_EQ(attempts(2).size(), 2u);
  run(kRetryFrom1m + std::string("max_attempts = 1\n"));
  EXPECT_EQ(attempts(6).size(), 1u);
  run("optimize_min_loops = 1\nrepropose_distance_m = 100\nretry_distance_m = 1\n");
  EXPECT_EQ(attempts(6).size(), 1u) << "never proposed again";
}

TEST_F(ScriptedLoops, FinishTriesWhatItsOwnOptimizationBroughtNear) {
  run("optimize_min_loops = 100\nrepropose_distance_m = 0.5\nretry_distance_m = 2\n");
  EXPECT_EQ(station_->base.optimizations(), 1u);
  EXPECT_EQ(attempts(6).size(), 2u);
}

TEST_F(ScriptedLoops, ScansBetweenKeyNodesShareTheirCorrection) {
  run(kRetryFrom2m);
  const auto trajectory = station_->base.tracks().trajectory(station_->base.graph(), kA);
  ASSERT_EQ(trajectory.size(), 23u);
  for (size_t i = 0; i < trajectory.size(); ++i) {
    const double odometry = static_cast<double>(i);  // 1 m a scan
    EXPECT_NEAR(trajectory[i].pose.translation().x(), odometry * 16 / 22, 0.01) << i;
  }
}

TEST_F(ScriptedLoops, GuessesCarryTheCovarianceOfTheOdometryBetweenThem) {
  run(kRetryFrom2m);
  Matrix6d expected = Matrix6d::Zero();
  for (uint32_t k = 1; k <= 6; ++k)
    expected = composeCovariance(expected, planarPose(2, 0, 0), edgeCovariance(k));
  EXPECT_GT(expected(1, 1), 1.0) << "the uncertain turn swings the far end";
  const auto& guess = attempts(6).at(0)->guess;
  ASSERT_TRUE(guess.covariance);
  EXPECT_LT((*guess.covariance - expected).norm(), 1e-5 * expected.norm()) << *guess.covariance;
}

TEST_F(ScriptedLoops, ARejectedLoopIsVerifiedButNoInlier) {
  run(kRetryFrom2m, "Gnc", 0.1);
  const LoopCounts counts = countLoops(station_->base);
  EXPECT_EQ(counts.verified, 1u);
  EXPECT_EQ(counts.inliers, 0u) << "6 m off, and neither it nor odometry is that uncertain";
  const PoseGraph& graph = station_->base.graph();
  EXPECT_EQ(countLoops(graph, graph.components().at(0)).within_robots, 0u);
  EXPECT_NEAR(keyNodeTrajectory(station_->base.graph(), kA)[11].pose.translation().x(), 22, 0.01);
}

/** What an operator does to the loop 0 - 11 after the run. */
class OperatorAfterScriptedLoops : public ScriptedLoops {
 protected:
  OperatorAfterScriptedLoops() { robots_.add("A"); }

  std::string apply(ActionKind kind, std::optional<size_t> loop_id = std::nullopt) {
    OperatorAction action;
    action.kind = kind;
    action.loop_id = loop_id;
    action.robot = "A";
    return station_->base.apply(action, robots_);
  }
  static OperatorAction byHand(const std::string& from, const std::string& to, double x_m) {
    OperatorAction action;
    action.kind = ActionKind::kAdd;
    action.from = from;
    action.to = to;
    action.position << x_m, 0, 0;
    action.sigma_m = 1e-4;
    action.sigma_deg = 0.01;
    return action;
  }
  size_t theLoop() const { return attempts(11).at(0)->loop_id; }
  double lastX() const {
    return keyNodeTrajectory(station_->base.graph(), kA)[11].pose.translation().x();
  }

  RobotTable robots_;
};

TEST_F(OperatorAfterScriptedLoops, AVetoedLoopIsOutUntilItIsRestored) {
  run(kRetryFrom2m);
  EXPECT_EQ(apply(ActionKind::kVeto, theLoop()), "done");
  EXPECT_NEAR(lastX(), 22, 0.01);
  EXPECT_EQ(countLoops(station_->base).inliers, 0u);
  EXPECT_EQ(apply(ActionKind::kRestore, theLoop()), "done");
  EXPECT_NEAR(lastX(), 16, 0.01);
}

TEST_F(OperatorAfterScriptedLoops, APinnedLoopIsNotRejected) {
  run(kRetryFrom2m, "Gnc", 0.1);
  EXPECT_NEAR(lastX(), 22, 0.01) << "the back end rejects it";
  EXPECT_EQ(apply(ActionKind::kPin, theLoop()), "done");
  EXPECT_LT(lastX(), 21);
  EXPECT_EQ(countLoops(station_->base).inliers, 1u);
  EXPECT_EQ(apply(ActionKind::kReset), "done");
  EXPECT_NEAR(lastX(), 22, 0.01);
}

TEST_F(OperatorAfterScriptedLoops, OnlyARemovedPairIsTriedAgainWhenItsGuessMoves) {
  for (const ActionKind kind : {ActionKind::kVeto, ActionKind::kRemove}) {
    run(kRetryFrom2m);
    apply(kind, theLoop());
    EXPECT_EQ(station_->base.apply(byHand("A:1", "A:11", 10), robots_), "done");
    const std::atomic<bool> interrupted{false};
    station_->base.finish(interrupted);
    EXPECT_EQ(attempts(11).size(), kind == ActionKind::kVeto ? 1u : 2u);
  }
}

TEST_F(OperatorAfterScriptedLoops, ALoopByHandIsPinned) {
  run(kRetryFrom2m);
  const auto fifthX = [&] {
    return keyNodeTrajectory(station_->base.graph(), kA)[5].pose.translation().x();
  };
  EXPECT_EQ(station_->base.apply(byHand("A:0", "A:5", 3), robots_), "done");
  EXPECT_NEAR(fifthX(), 3, 0.01);
  const LedgerRow row = *attempts(5).back();
  EXPECT_EQ(row.candidate.generator, "operator");
  EXPECT_EQ(apply(ActionKind::kRemove, row.loop_id), "done");
  EXPECT_NEAR(fifthX(), 5 * 16.0 / 11, 0.05);
  EXPECT_EQ(apply(ActionKind::kRestore, row.loop_id), "done");
  EXPECT_NEAR(fifthX(), 3, 0.01);
  EXPECT_TRUE(station_->base.graph().edges()[*row.edge].pinned) << "as it was before";
}

TEST_F(OperatorAfterScriptedLoops, WhileFrozenNothingMoves) {
  run(kRetryFrom2m);
  apply(ActionKind::kFreeze);
  const size_t optimizations = station_->base.optimizations();
  apply(ActionKind::kVeto, theLoop());
  EXPECT_NEAR(lastX(), 16, 0.01);
  EXPECT_EQ(station_->base.optimizations(), optimizations);
  apply(ActionKind::kUnfreeze);
  EXPECT_NEAR(lastX(), 22, 0.01);
}

TEST_F(OperatorAfterScriptedLoops, WhatCannotBeDoneIsToldAndRecorded) {
  run(kRetryFrom2m);
  EXPECT_EQ(apply(ActionKind::kVeto, 999), "no such loop closure has been verified yet");
  OperatorAction action;
  action.kind = ActionKind::kPin;
  action.from = "A:0";
  action.to = "A:77";
  EXPECT_EQ(station_->base.apply(action, robots_), "there is no key node A:77 yet");
  action.kind = ActionKind::kIgnore;
  action.robot = "Z";
  EXPECT_EQ(station_->base.apply(action, robots_), "there is no key node of a robot 'Z' yet");
  ASSERT_EQ(station_->base.actions().size(), 3u);
  EXPECT_EQ(station_->base.actions()[2].outcome, "there is no key node of a robot 'Z' yet");
}

/** So many loop closures of robot a, of which the back end has kept some. */
PoseGraph withLoops(size_t loops, size_t kept) {
  PoseGraph graph;
  for (uint32_t i = 0; i < 2; ++i) {
    Node node;
    node.id = {kA, i};
    graph.addNode(node);
  }
  for (size_t k = 0; k < loops; ++k) {
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = {kA, 0};
    edge.to = {kA, 1};
    edge.verdict = k < kept ? Verdict::kInlier : Verdict::kOutlier;
    graph.addEdge(edge);
  }
  return graph;
}

TEST(KeptLoops, AreTooFewBelowATenth) {
  EXPECT_TRUE(keptLoops(withLoops(21, 2), {}).tooFew());
  EXPECT_TRUE(keptLoops(withLoops(10, 0), {}).tooFew());
  EXPECT_FALSE(keptLoops(withLoops(20, 2), {}).tooFew());
  EXPECT_FALSE(keptLoops(withLoops(9, 0), {}).tooFew()) << "a tenth is less than one";
}

TEST(KeptLoops, OfRobotsThatStayApartDoNotCount) {
  PoseGraph graph = withLoops(3, 3);
  Node node;
  node.id = {kB, 0};
  graph.addNode(node);
  for (int k = 0; k < 40; ++k) {
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = {kB, 0};
    edge.to = {kA, 1};
    edge.verdict = Verdict::kOutlier;
    graph.addEdge(edge);
  }
  FrameAgreement frames{kA, kB};
  EXPECT_EQ(keptLoops(graph, {frames}).loops, 3u);
  EXPECT_FALSE(keptLoops(graph, {frames}).tooFew());
  frames.joined = true;
  EXPECT_TRUE(keptLoops(graph, {frames}).tooFew()) << "joined, and hardly a loop closure kept";
}

}  // namespace
}  // namespace lamp
