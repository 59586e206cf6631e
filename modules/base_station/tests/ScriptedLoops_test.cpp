// What the base station makes of loop closures that are known beforehand, and of an operator's
// actions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "OneAnswer.h"
#include "TestTeam.h"
#include "lamp/base_station/LoopCounts.h"

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

}  // namespace lamp

IMPLEMENTS_MRPT_OBJECT(ScriptedCandidates, lamp::CandidateGenerator, lamp)
IMPLEMENTS_MRPT_OBJECT(OneAnswer, lamp::Refiner, lamp)

namespace lamp {
namespace {

using namespace test;

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

}  // namespace
}  // namespace lamp
