#include "lamp/evaluation/LoopEvaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestRuns.h"
#include "TestScans.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/evaluation/KeyedScans.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;
using Points = std::vector<Eigen::Vector3f>;

/** A wall along x in a world frame, seen from a robot at the given x. */
Points wallSeenFrom(double x) {
  Points points;
  for (int i = -20; i < 20; ++i)
    for (int k = 0; k < 10; ++k) points.emplace_back(0.2f * i + 0.1f, 2.1f, 0.2f * k + 0.1f);
  for (auto& p : points) p.x() += static_cast<float>(std::round(x) - x);
  return points;
}

const char* const kHeader =
    "loop_id,attempt,round,from,to,generator,stage,reason,x,y,z,qx,qy,qz,qw,verdict,new_column\n";

std::string row(int id, int attempt, const std::string& from, const std::string& to,
                const std::string& stage, const Pose3& T, const std::string& verdict) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d t = T.translation();
  std::string text = std::to_string(id) + "," + std::to_string(attempt) + ",0," + from + "," + to +
                     ",X," + stage + ",";
  for (const double v : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    text += "," + formatFixed(v, 6);
  return text + "," + verdict + ",?\n";
}

/** An edge with its own deviations along x, y, z and the rotations. */
std::string g2oEdge(int from, int to, const Pose3& T, const Vector6d& sigma) {
  const Matrix6d I =
      toG2oInformation(Matrix6d(sigma.array().square().inverse().matrix().asDiagonal()));
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d t = T.translation();
  std::string text = "EDGE_SE3:QUAT " + std::to_string(from) + " " + std::to_string(to);
  for (const double v : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    text += " " + formatDouble(v);
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) text += " " + formatDouble(I(i, j));
  return text + "\n";
}

/** Two robots on the x axis: a's key nodes at x = 0, 1, 2, 8, b's at 0, 1, 20. All see the wall for
 * 4 m to both sides. Between two of them at distance d the overlap is about 1 - d / 8. */
class Ledger : public testing::Test {
 protected:
  Ledger() : run_(freshFolder()) {
    addRobot("a", {0, 1, 2, 8});
    addRobot("b", {0, 1, 20});
    writeTextFile(run_.folder().graphIds(),
                  "id,robot,index,symbol,stamp\n0,a,0,0,100\n1,a,1,0,101\n2,a,2,0,102\n"
                  "3,a,3,0,103\n4,b,0,0,100\n5,b,1,0,101\n6,b,2,0,102\n");
    writeTextFile(run_.folder().graphG2o(), "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n");
  }

  void addRobot(const std::string& name, const std::vector<double>& places) {
    Path path;
    std::map<double, Points> scans;
    for (const double x : places) {
      const double stamp = 100.0 + static_cast<double>(path.size());
      path.push_back({stamp, pose(x, 0, 0)});
      scans[stamp] = wallSeenFrom(x);
    }
    run_.addRobot(name, path, path);
    writeKeyedScans(run_.folder().keyNodes(name), scans);
  }
  LoopEvaluation evaluate(const std::string& rows) const {
    writeTextFile(run_.folder().loops(), kHeader + rows);
    return evaluateLoops(RunFiles::open(run_.root()), TruthFolder(run_.truth()));
  }

  TestRun run_;
};

TEST_F(Ledger, CountsAreThoseOfTheHand) {
  const LoopEvaluation e = evaluate(
      // Within a. A true pair, right and kept, with an error of 0.1 m; tried twice.
      row(0, 1, "a:0", "a:1", "Gicp", pose(3, 0, 0), "refused") +
      row(0, 2, "a:0", "a:1", "verified", pose(1.1, 0, 0), "inlier") +
      // A true pair that was refused, with a right pose.
      row(1, 1, "a:0", "a:2", "OverlapResidual", pose(2, 0, 0), "refused") +
      // A false pair (8 m) whose wrong pose was kept.
      row(2, 1, "a:0", "a:3", "verified", pose(2, 0, 0), "inlier") +
      // Between the robots. A true pair, wrong by 3 m, verified and rejected by the back end.
      row(3, 1, "a:1", "b:1", "verified", pose(3, 0, 0), "outlier") +
      // A true pair, neither right nor wrong by 0.5 m, kept.
      row(4, 1, "a:2", "b:1", "verified", pose(-1.5, 0, 0), "inlier") +
      // False (20 m) and refused before there was a pose.
      row(5, 1, "a:0", "b:2", "Odometry", Pose3::Identity(), "refused") +
      // At 7 m an overlap of an eighth: not scored as a pair, but its pose is right.
      row(6, 1, "b:1", "a:3", "verified", pose(7, 0, 0), "inlier"));
  ASSERT_EQ(e.loops.size(), 7u);

  const StageScore& generated = e.all.generated;
  EXPECT_EQ(generated.accepted, 7u);
  EXPECT_EQ(generated.true_pairs, 4u);
  EXPECT_EQ(generated.false_pairs, 2u);
  EXPECT_EQ(generated.between_pairs, 1u);
  EXPECT_EQ(generated.unknown_pairs, 0u);
  EXPECT_EQ(generated.not_judged, 1u);
  EXPECT_EQ(generated.right, 3u);
  EXPECT_EQ(generated.wrong, 2u);
  EXPECT_EQ(generated.neither, 1u);

  const StageScore& verified = e.all.verified;
  EXPECT_EQ(verified.accepted, 5u);
  EXPECT_EQ(verified.right, 2u);
  EXPECT_EQ(verified.wrong, 2u);
  EXPECT_DOUBLE_EQ(*LoopScore::precision(verified), 0.5);
  EXPECT_DOUBLE_EQ(*e.all.recall(verified), 0.25);
  EXPECT_DOUBLE_EQ(*e.all.recallOfPairs(verified), 0.75);
  EXPECT_DOUBLE_EQ(*e.all.falsePositives(verified), 0.5);

  const StageScore& kept = e.all.kept;
  EXPECT_EQ(kept.accepted, 4u);
  EXPECT_EQ(kept.right, 2u);
  EXPECT_EQ(kept.wrong, 1u);
  EXPECT_DOUBLE_EQ(*LoopScore::precision(kept), 2.0 / 3);
  EXPECT_DOUBLE_EQ(*e.all.recall(kept), 0.25);
  EXPECT_DOUBLE_EQ(*e.all.recallOfPairs(kept), 0.5);
  EXPECT_DOUBLE_EQ(*e.all.falsePositives(kept), 0.5);
  EXPECT_NEAR(e.all.translation_m.mean, (0.1 + 6 + 0.5 + 0) / 4, 1e-6);
  EXPECT_NEAR(e.all.translation_m.median, 0.3, 1e-6);
  EXPECT_NEAR(e.all.translation_m.max, 6, 1e-6);

  EXPECT_EQ(e.within_robots.generated.accepted, 3u);
  EXPECT_EQ(e.within_robots.kept.right, 1u);
  EXPECT_EQ(e.between_robots.generated.accepted, 4u);
  EXPECT_EQ(e.between_robots.kept.right, 1u);
  EXPECT_DOUBLE_EQ(*e.between_robots.falsePositives(e.between_robots.kept), 0);
}

TEST_F(Ledger, KeptLoopsAreJudgedWhereTheyClaimToKnow) {
  Vector6d along_x_unknown;
  along_x_unknown << 2.0, 0.05, 0.05, 0.01, 0.01, 0.01;
  const Pose3 slipped = pose(4, 0, 0), odometry = pose(1, 0, 0);
  const std::string rows = row(0, 1, "a:0", "a:1", "verified", slipped, "inlier");
  EXPECT_EQ(evaluate(rows).loops[0].closure, ClosureKind::kWrong) << "no information: all count";
  Vector6d all_known;
  all_known << 0.1, 0.1, 0.1, 0.01, 0.01, 0.01;
  // An odometry edge between the two nodes is another edge.
  writeTextFile(run_.folder().graphG2o(),
                g2oEdge(0, 1, odometry, all_known) + g2oEdge(0, 1, slipped, along_x_unknown));
  EXPECT_EQ(evaluate(rows).loops[0].closure, ClosureKind::kRight) << "3 m along the tunnel";
  writeTextFile(run_.folder().graphG2o(), g2oEdge(0, 1, slipped, all_known));
  EXPECT_EQ(evaluate(rows).loops[0].closure, ClosureKind::kWrong);
}

TEST_F(Ledger, MissingTruthAndScansMakePairsUnknown) {
  const std::string rows = row(0, 1, "a:0", "b:1", "verified", pose(1, 0, 0), "inlier");
  std::filesystem::remove(run_.folder().keyNodes("b"));
  LoopEvaluation e = evaluate(rows);
  EXPECT_EQ(e.all.kept.unknown_pairs, 1u);
  EXPECT_EQ(e.all.kept.right, 1u);
  EXPECT_THAT(e.warnings, testing::Contains(HasSubstr("b.rawlog': which of its pairs")));
  EXPECT_FALSE(e.all.recall(e.all.kept)) << "no true pair is known";
  std::filesystem::remove(run_.truth() + "/b.tum");
  e = evaluate(rows);
  EXPECT_EQ(e.all.kept.not_judged, 1u);
  EXPECT_FALSE(LoopScore::precision(e.all.kept));
}

TEST_F(Ledger, AnEmptyLedgerHasNoFigures) {
  const LoopEvaluation e = evaluate("");
  EXPECT_EQ(e.all.generated.accepted, 0u);
  EXPECT_FALSE(LoopScore::precision(e.all.kept));
  EXPECT_FALSE(e.all.falsePositives(e.all.kept));
}

TEST_F(Ledger, DamagedFilesAreErrorsWithTheirPlace) {
  const auto error = [&](const std::string& rows) { return thrownBy([&] { evaluate(rows); }); };
  const std::string good = row(0, 1, "a:0", "b:1", "verified", pose(1, 0, 0), "inlier");
  EXPECT_THAT(error("1,2\n"), HasSubstr("loops.csv:2"));
  EXPECT_THAT(error(row(0, 1, "a:9", "b:1", "verified", pose(1, 0, 0), "inlier")),
              HasSubstr("'a:9' is not in graph_ids.csv"));
  Pose3 bad = pose(1, 0, 0);
  bad.translation().x() = std::nan("");
  EXPECT_THAT(error(row(0, 1, "a:0", "b:1", "verified", bad, "inlier")),
              HasSubstr("loops.csv, row 1: 'nan' is no x"));
  writeTextFile(run_.folder().graphG2o(), "EDGE_SE3:QUAT 0 1 1 2 3\n");
  EXPECT_THAT(error(good), HasSubstr("graph.g2o:1"));
  std::filesystem::remove(run_.folder().graphG2o());
  EXPECT_THAT(error(good), HasSubstr("graph.g2o"));
}

TEST(ClosureKind, LimitsAreThoseOfTheDefinition) {
  EXPECT_EQ(closureKind(pose(0.19, 0, 0), {}), ClosureKind::kRight);
  EXPECT_EQ(closureKind(pose(0.21, 0, 0), {}), ClosureKind::kNeither);
  EXPECT_EQ(closureKind(pose(0.99, 0, 0), {}), ClosureKind::kNeither);
  EXPECT_EQ(closureKind(pose(0.8, 0.8, 0), {}), ClosureKind::kWrong);
  EXPECT_EQ(closureKind(pose(0, 0, 0, 1.9 * kDegree), {}), ClosureKind::kRight);
  EXPECT_EQ(closureKind(pose(0, 0, 0, 2.1 * kDegree), {}), ClosureKind::kNeither);
  EXPECT_EQ(closureKind(pose(0, 0, 0, 0, 5.1 * kDegree), {}), ClosureKind::kWrong);
}

TEST(ClosureKind, DirectionsWithoutClaimDoNotCount) {
  const auto information = [](double translation, double rotation_deg) {
    Vector6d sigma;
    sigma << 0.1, translation, 0.1, 0.01, 0.01, rotation_deg * kDegree;
    return Matrix6d(sigma.array().square().inverse().matrix().asDiagonal());
  };
  EXPECT_EQ(closureKind(pose(0, 9, 0), information(0.51, 1)), ClosureKind::kRight);
  EXPECT_EQ(closureKind(pose(0, 9, 0), information(0.49, 1)), ClosureKind::kWrong);
  EXPECT_EQ(closureKind(pose(0, 0, 0, 1), information(0.1, 2.1)), ClosureKind::kRight);
  EXPECT_EQ(closureKind(pose(0, 0, 0, 1), information(0.1, 1.9)), ClosureKind::kWrong);
  EXPECT_EQ(closureKind(pose(0, 0, 0), Matrix6d(Matrix6d::Zero())), ClosureKind::kNeither);
}

TEST(PairKind, LimitsAreThoseOfTheDefinition) {
  EXPECT_EQ(pairKind(0.3), PairKind::kTrue);
  EXPECT_EQ(pairKind(0.299), PairKind::kBetween);
  EXPECT_EQ(pairKind(0.05), PairKind::kBetween);
  EXPECT_EQ(pairKind(0.049), PairKind::kFalse);
}

TEST(KeyedScans, AreInTheBaseFrameAndADamagedFileGivesItsBeginning) {
  const std::string path = freshFolder() + "/a.rawlog";
  std::map<double, Points> scans;
  for (int i = 0; i < 20; ++i) scans[100.0 + i] = wallSeenFrom(0.01 * i);
  writeKeyedScans(path, scans);
  const KeyedScans whole = readKeyedScans(path);
  EXPECT_EQ(whole.damage, "");
  ASSERT_EQ(whole.by_stamp.size(), 20u);
  ASSERT_NE(whole.at(105.00005), nullptr);
  EXPECT_LT((whole.at(105)->at(3) - scans[105][3]).norm(), 1e-6);
  EXPECT_EQ(whole.at(105.01), nullptr);
  const std::string bytes = readTextFile(path);
  writeTextFile(path, bytes.substr(0, bytes.size() / 2));
  const KeyedScans half = readKeyedScans(path);
  EXPECT_LT(half.by_stamp.size(), 20u);
  EXPECT_THAT(half.damage, HasSubstr("is damaged after"));
  EXPECT_THAT(thrownBy([] { readKeyedScans("/nowhere.rawlog"); }), HasSubstr("/nowhere.rawlog"));
}

}  // namespace
}  // namespace lamp::evaluation
