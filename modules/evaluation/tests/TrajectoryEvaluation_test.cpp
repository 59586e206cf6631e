#include "lamp/evaluation/TrajectoryEvaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestRuns.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;

TrajectoryEvaluation evaluate(const TestRun& run, Alignment alignment = Alignment::kNone) {
  return evaluateTrajectories(RunFiles::open(run.root()), TruthFolder(run.truth()), alignment);
}

double rmse(const TestRun& run, Alignment alignment) {
  return Statistics::of(evaluate(run, alignment).result.error.position_m).rmse;
}

constexpr Alignment kAll[] = {Alignment::kNone, Alignment::kFirst, Alignment::kTeam,
                              Alignment::kSe3};

TEST(TrajectoryEvaluation, APerfectRunHasNoErrorInAnyAlignment) {
  TestRun run(freshFolder());
  run.addRobot("a", windingPath(300), windingPath(300));
  run.addRobot("b", moved(windingPath(200), pose(3, 4, 5)), moved(windingPath(200), pose(3, 4, 5)));
  for (const Alignment alignment : kAll) {
    const auto result = evaluate(run, alignment).result;
    EXPECT_EQ(result.error.position_m.size(), 500u);
    EXPECT_LT(Statistics::of(result.error.position_m).max, 1e-6) << toString(alignment);
    EXPECT_LT(Statistics::of(result.error.rotation_deg).max, 1e-5) << toString(alignment);
  }
}

TEST(TrajectoryEvaluation, ARigidOffsetIsSeenWithoutAlignmentOnly) {
  TestRun run(freshFolder());
  run.addRobot("a", moved(windingPath(300), pose(0.3, -0.4, 1.2)), windingPath(300));
  EXPECT_NEAR(rmse(run, Alignment::kNone), 1.3, 1e-6) << "3, 4, 12 and 13";
  for (const Alignment alignment : {Alignment::kFirst, Alignment::kTeam, Alignment::kSe3})
    EXPECT_LT(rmse(run, alignment), 1e-6) << toString(alignment);
}

TEST(TrajectoryEvaluation, ATurnedWorldIsAlignedInRotationToo) {
  TestRun run(freshFolder());
  run.addRobot("a", moved(windingPath(300), pose(5, 6, 7, 2.0, 0.3, -0.4)), windingPath(300));
  const auto none = Statistics::of(evaluate(run).result.error.rotation_deg);
  const double angle = rotationAngle(pose(0, 0, 0, 2.0, 0.3, -0.4)) / kDegree;
  EXPECT_NEAR(none.mean, angle, 1e-5);
  EXPECT_NEAR(none.max, angle, 1e-5);
  for (const Alignment alignment : {Alignment::kFirst, Alignment::kTeam, Alignment::kSe3}) {
    EXPECT_LT(rmse(run, alignment), 1e-5) << toString(alignment);
    EXPECT_LT(Statistics::of(evaluate(run, alignment).result.error.rotation_deg).max, 1e-4);
  }
}

TEST(TrajectoryEvaluation, AScaleErrorGrowsWithDistanceAndIsItsOwnDrift) {
  TestRun run(freshFolder());
  run.addRobot("a", straightPath(1001, 0.202), straightPath(1001, 0.2));  // 200 m, 1 % too long
  const auto result = evaluate(run).result;
  const auto error = Statistics::of(result.error.position_m);
  EXPECT_NEAR(error.max, 2.0, 1e-6);
  EXPECT_NEAR(error.mean, 1.0, 1e-6);
  EXPECT_NEAR(error.rmse, 2.0 / std::sqrt(3.0), 1e-3);
  EXPECT_NEAR(*result.drift_10m.meanTranslation(), 1.0, 1e-4);
  EXPECT_NEAR(*result.drift_100m.meanTranslation(), 1.0, 1e-4);
  EXPECT_NEAR(*result.drift_100m.meanRotation(), 0.0, 1e-6);
  EXPECT_EQ(result.drift_100m.translation_percent.size(), 501u);
  EXPECT_NEAR(result.error.distance_m.back(), 200, 1e-6);
  // Least squares halves it at both ends: an error from -1 m to 1 m.
  EXPECT_NEAR(rmse(run, Alignment::kSe3), 1.0 / std::sqrt(3.0), 1e-3);
}

TEST(TrajectoryEvaluation, AConstantTurnIsRotationDrift) {
  Path estimate = straightPath(501, 0.2);
  for (size_t i = 0; i < estimate.size(); ++i)
    estimate[i].pose.linear() =
        Eigen::AngleAxisd(0.02 * kDegree * static_cast<double>(i), Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
  TestRun run(freshFolder());
  run.addRobot("a", estimate, straightPath(501, 0.2));
  EXPECT_NEAR(*evaluate(run).result.drift_10m.meanRotation(), 0.1, 1e-6) << "0.02° each 0.2 m";
}

TEST(TrajectoryEvaluation, ASingleJumpCountsFromThereOn) {
  Path estimate = straightPath(400, 0.5);
  for (size_t i = 300; i < 400; ++i) estimate[i].pose.translation().y() += 2;
  TestRun run(freshFolder());
  run.addRobot("a", estimate, straightPath(400, 0.5));
  const auto result = evaluate(run).result;
  const auto error = Statistics::of(result.error.position_m);
  EXPECT_NEAR(error.max, 2.0, 1e-6);
  EXPECT_NEAR(error.mean, 0.5, 1e-6);
  EXPECT_NEAR(error.rmse, 1.0, 1e-6);
  EXPECT_NEAR(rmse(run, Alignment::kFirst), 1.0, 1e-6);
  // 20 of the 380 segments of 10 m see the 2 m; none before and none behind.
  EXPECT_NEAR(*result.drift_10m.meanTranslation(), 20.0 * 20 / 380, 1e-4);
}

TEST(TrajectoryEvaluation, Se3HidesSwappedFramesAndTeamDoesNot) {
  const Pose3 of_a = pose(0, 0, 0), of_b = pose(10, 0, 0, 1.0);
  const Path a = windingPath(200), b = windingPath(200, 100, 0.2);
  TestRun run(freshFolder());
  run.addRobot("a", moved(a, of_b), moved(a, of_a));
  run.addRobot("b", moved(b, of_a), moved(b, of_b));
  EXPECT_LT(rmse(run, Alignment::kSe3), 1e-5);
  EXPECT_GT(rmse(run, Alignment::kTeam), 3.0);
  EXPECT_GT(rmse(run, Alignment::kFirst), 3.0);
  EXPECT_GT(rmse(run, Alignment::kNone), 3.0);
}

TEST(TrajectoryEvaluation, TeamAlignsEachComponentForItself) {
  TestRun run(freshFolder());
  run.addRobot("a", moved(windingPath(200), pose(1, 2, 3, 1)), windingPath(200), 0);
  run.addRobot("b", moved(windingPath(200), pose(-7, 0, 0, 2)), windingPath(200), 1);
  EXPECT_LT(rmse(run, Alignment::kTeam), 1e-5);
  EXPECT_LT(rmse(run, Alignment::kFirst), 1e-5);
}

TEST(TrajectoryEvaluation, TheOdometryIsScoredToo) {
  TestRun run(freshFolder());
  run.addRobot("a", windingPath(100), windingPath(100));
  writeTextFile(run.folder().odometryTrajectory("a"),
                toTum(moved(windingPath(100), pose(0, 0, 0.5))));
  const auto all = evaluate(run);
  EXPECT_LT(Statistics::of(all.result.error.position_m).max, 1e-6);
  EXPECT_NEAR(Statistics::of(all.odometry.error.position_m).mean, 0.5, 1e-6);
  EXPECT_FALSE(all.result.drift_100m.meanTranslation()) << "the path is 50 m long";
}

TEST(TrajectoryEvaluation, TruthIsInterpolatedBetweenItsStamps) {
  TestRun run(freshFolder());
  Path between = straightPath(99, 0.5, 100.05);
  for (StampedPose& p : between) p.pose.translation().x() += 0.25;
  run.addRobot("a", between, straightPath(100, 0.5));
  EXPECT_LT(rmse(run, Alignment::kNone), 1e-6);
}

TEST(TrajectoryEvaluation, WhatTheTruthDoesNotCoverIsNotScored) {
  const Path whole = straightPath(200, 0.5);
  Path half(whole.begin(), whole.begin() + 100);
  Path estimate = whole;
  for (size_t i = 100; i < 200; ++i) estimate[i].pose.translation().y() = 50;  // nobody can know
  TestRun run(freshFolder());
  run.addRobot("a", estimate, half);
  const auto all = evaluate(run);
  EXPECT_EQ(all.result.joined, 100u);
  EXPECT_EQ(all.result.estimated, 200u);
  EXPECT_LT(Statistics::of(all.result.error.position_m).max, 1e-6);
  EXPECT_THAT(all.warnings, testing::Contains(HasSubstr("only 50.0 % of the run's scans")));
}

TEST(TrajectoryEvaluation, GapsInTheTruthAreNotBridged) {
  Path truth = straightPath(200, 0.5);
  truth.erase(truth.begin() + 50, truth.begin() + 70);  // 2 s
  TestRun run(freshFolder());
  run.addRobot("a", straightPath(200, 0.5), truth);
  const auto all = evaluate(run);
  EXPECT_EQ(all.result.joined, 180u);
  // 180 segments of 10 m start within the path; those that begin or cover the gap are left out.
  EXPECT_EQ(all.result.drift_10m.translation_percent.size(), 30u + 110u);
}

TEST(TrajectoryEvaluation, ARunThatEndsEarlySaysHowMuchOfTheTruthItCovers) {
  const Path whole = straightPath(200, 0.5);
  TestRun run(freshFolder());
  run.addRobot("a", Path(whole.begin(), whole.begin() + 50), whole);
  const auto all = evaluate(run);
  EXPECT_EQ(all.result.joined, 50u);
  EXPECT_EQ(all.result.true_poses, 200u);
  EXPECT_EQ(all.result.true_poses_met, 50u);
  EXPECT_THAT(all.warnings, testing::Contains(HasSubstr("only 25.0 % of the true trajectory")));
}

TEST(TrajectoryEvaluation, RobotsOnOneSideOnlyAreNamed) {
  TestRun run(freshFolder());
  run.addRobot("a", windingPath(100), windingPath(100));
  run.addRobot("b", windingPath(100), {});
  writeTextFile(run.truth() + "/c.tum", toTum(windingPath(300)));
  const auto all = evaluate(run);
  EXPECT_EQ(all.robots.size(), 1u);
  EXPECT_EQ(all.result.true_poses, 400u);
  EXPECT_EQ(all.result.true_poses_met, 100u);
  EXPECT_THAT(all.warnings, testing::Contains(HasSubstr("robot 'b' has no ")));
  EXPECT_THAT(all.warnings, testing::Contains(HasSubstr("a robot 'c' that the run does not have")));
}

TEST(TrajectoryEvaluation, NoCommonRobotOrTimeIsAnError) {
  TestRun run(freshFolder());
  run.addRobot("a", windingPath(100, 500), windingPath(100, 100));
  EXPECT_THAT(thrownBy([&] { evaluate(run); }),
              testing::AllOf(HasSubstr("robot 'a'"), HasSubstr("500.000 to 509.900"),
                             HasSubstr("100.000 to 109.900")));
  std::filesystem::rename(run.truth() + "/a.tum", run.truth() + "/z.tum");
  EXPECT_THAT(thrownBy([&] { evaluate(run); }), HasSubstr("no true trajectory of a robot"));
}

TEST(TrajectoryEvaluation, ExchangedTruthFilesAreRefused) {
  TestRun run(freshFolder());
  const Path a = windingPath(200), b = straightPath(200, 0.5);
  run.addRobot("a", a, b);
  run.addRobot("b", b, a);
  EXPECT_THAT(thrownBy([&] { evaluate(run); }), HasSubstr("were the files swapped?"));
}

TEST(TrajectoryEvaluation, PlanarRobotsAreComparedInThePlane) {
  Path truth;
  for (const StampedPose& p : windingPath(200)) {
    const Pose3 flat = projectToPlane(p.pose);
    truth.push_back({p.stamp, pose(0, 0, 0.4) * flat * pose(0, 0, 0, 0, 0.05, 0.02)});
  }
  Path estimate = truth;
  for (StampedPose& p : estimate) p.pose = projectToPlane(p.pose);
  TestRun run(freshFolder());
  run.addRobot("a", moved(estimate, pose(1, 0, 0, 0.5)), truth, 0, true);
  EXPECT_LT(rmse(run, Alignment::kTeam), 1e-6);
  const auto all = evaluate(run, Alignment::kTeam);
  EXPECT_LT(Statistics::of(all.result.error.rotation_deg).max, 1e-5);
  EXPECT_THAT(all.warnings, testing::Contains(HasSubstr("mapped in the plane")));
  EXPECT_NEAR(all.robots[0].mean_true_height_m, 0.4, 1e-6);
}

TEST(TrajectoryEvaluation, NotFiniteAndEmptyTrajectoriesAreErrorsWithTheirLine) {
  TestRun run(freshFolder());
  run.addRobot("a", windingPath(100), windingPath(100));
  writeTextFile(run.truth() + "/a.tum", "1 0 0 0 0 0 0 1\n2 nan 0 0 0 0 0 1\n");
  EXPECT_THAT(thrownBy([&] { evaluate(run); }), HasSubstr("a.tum:2"));
  writeTextFile(run.truth() + "/a.tum", "");
  EXPECT_THAT(thrownBy([&] { evaluate(run); }), HasSubstr("holds no pose"));
}

TEST(FitRigid, OnAStraightLineTheOrientationsDecide) {
  const Pose3 truth_T_estimate = pose(1, 2, 3, 0.5, -0.2, 0.7);
  std::vector<JoinedPose> poses;
  for (const StampedPose& p : straightPath(50, 0.5))
    poses.push_back({p.stamp, truth_T_estimate.inverse() * p.pose, p.pose, 0});
  EXPECT_LT((fitRigid(poses, false).matrix() - truth_T_estimate.matrix()).norm(), 1e-6);
  EXPECT_LT((fitRigid({poses.front()}, false).matrix() - truth_T_estimate.matrix()).norm(), 1e-6);
}

TEST(FitRigid, IsEigensUmeyamaWithoutScale) {
  std::vector<JoinedPose> poses;
  Eigen::Matrix3Xd from(3, 200), to(3, 200);
  const Path truth = windingPath(200);
  for (int i = 0; i < 200; ++i) {
    const double wave = std::sin(1.7 * i);
    const Pose3 estimate = pose(4, 5, 6, 1) * truth[i].pose * pose(0.3 * wave, 0.2, 0.1 * wave);
    poses.push_back({truth[i].stamp, estimate, truth[i].pose, 0});
    from.col(i) = estimate.translation();
    to.col(i) = truth[i].pose.translation();
  }
  const Eigen::Matrix4d expected = Eigen::umeyama(from, to, false);
  EXPECT_LT((fitRigid(poses, false).matrix() - expected).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Statistics, OfKnownValues) {
  const Statistics s = Statistics::of({4, 1, 2, 3});
  EXPECT_EQ(s.count, 4u);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(30.0 / 4));
  EXPECT_DOUBLE_EQ(s.std, std::sqrt(5.0 / 4));
  EXPECT_DOUBLE_EQ(s.median, 2.5);
  EXPECT_DOUBLE_EQ(s.p95, 3.85);
  EXPECT_DOUBLE_EQ(s.max, 4);
  EXPECT_EQ(Statistics::of({}).count, 0u);
}

TEST(RunFiles, FoldersThatAreNoRunsAreErrors) {
  const std::string root = freshFolder();
  EXPECT_THAT(thrownBy([&] { RunFiles::open(root + "/nowhere"); }), HasSubstr("no run folder"));
  EXPECT_THAT(thrownBy([&] { RunFiles::open(root); }), HasSubstr("has no summary.json"));
  writeTextFile(root + "/summary.json", "{\"robots\": [");
  EXPECT_THAT(thrownBy([&] { RunFiles::open(root); }), HasSubstr("is not valid JSON"));
  writeTextFile(root + "/summary.json", "{}");
  EXPECT_THAT(thrownBy([&] { RunFiles::open(root); }), HasSubstr("is not the summary of a run"));
  writeTextFile(root + "/summary.json", R"({"robots":[{"name":"a"}],"components":[]})");
  EXPECT_THAT(thrownBy([&] { RunFiles::open(root); }), HasSubstr("no trajectories/<robot>.tum"));
}

TEST(TruthFolder, MayBeASubfolderAndMustHoldTrajectories) {
  const std::string root = freshFolder();
  EXPECT_THAT(thrownBy([&] { TruthFolder{root}; }), HasSubstr("contains no true trajectory"));
  std::filesystem::create_directories(root + "/truth");
  writeTextFile(root + "/truth/b.tum", toTum(windingPath(2)));
  EXPECT_EQ(TruthFolder(root).root(), root + "/truth");
  EXPECT_TRUE(TruthFolder(root).has("b"));
  EXPECT_FALSE(TruthFolder(root).has("a"));
}

}  // namespace
}  // namespace lamp::evaluation
