#include "lamp/evaluation/ScannedPoints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestClouds.h"
#include "TestRuns.h"
#include "TestScans.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;
using Points = std::vector<Eigen::Vector3f>;

/** A robot that drives 1 m along x within 1 s over a floor, and its run says 2 m to the left. Its
 * scans are of stamps 100 and 101. */
class ScannedRun : public testing::Test {
 protected:
  ScannedRun() {
    const Path truth = straightPath(11, 0.1);
    const Path estimate = moved(truth, pose(0, 2, 0));
    run_.addRobot("a", estimate, truth);
    writeTextFile(run_.folder().keyNodeTrajectory("a"), toTum({estimate.front(), estimate.back()}));
    addLevel(-5, 9, -5, 5, 0, 1, floor_);
  }
  void writeScans(const Points& first, const Points& second) const {
    writeKeyedScans(run_.folder().keyNodes("a"), {{100, first}, {101, second}});
  }
  /** Rows `scan x y z`. */
  void writeMovers(const std::string& rows) const {
    writeTextFile(run_.truth() + "/a.movers.ply",
                  "ply\nformat ascii 1.0\nelement vertex " +
                      std::to_string(std::count(rows.begin(), rows.end(), '\n')) +
                      "\nproperty float scan\nproperty float x\nproperty float y\n"
                      "property float z\nend_header\n" +
                      rows);
  }
  ScannedPoints scanned() const {
    return scannedPoints(RunFiles::open(run_.root()), 0, TruthFolder(run_.truth()),
                         Pose3::Identity(), TrueSurface(floor_));
  }

  const TemporaryFolder folder_;
  TestRun run_{folder_.path()};
  SurfaceSamples floor_;
};

TEST_F(ScannedRun, PointsAreToldApartAndPlacedAsTheRunDoes) {
  writeScans({{2, 0, 1}, {2, 0, 0.1f}, {3, 0, 2}}, {{2, 0, 1}, {1, 1, 0}});
  writeMovers("0 2 0 1.02\n0 2 0 0.1\n");
  const ScannedPoints points = scanned();
  EXPECT_THAT(points.notes, testing::IsEmpty());
  ASSERT_EQ(points.moving.size(), 1u) << "not the foot at the floor";
  EXPECT_LT((points.moving[0] - Eigen::Vector3f(2, 2, 1)).norm(), 1e-4);
  ASSERT_EQ(points.fixed.size(), 1u);
  EXPECT_LT((points.fixed[0] - Eigen::Vector3f(2, 3, 0)).norm(), 1e-4) << "of the second scan";
  EXPECT_EQ(points.stray.size(), 2u) << "also where another scan saw something that moved";
}

TEST_F(ScannedRun, WithoutMoversNothingMoves) {
  writeScans({{2, 0, 1}, {2, 0, 0.1f}}, {});
  const ScannedPoints points = scanned();
  EXPECT_EQ(points.moving.size(), 0u);
  EXPECT_EQ(points.fixed.size(), 1u);
  EXPECT_EQ(points.stray.size(), 1u);
}

TEST_F(ScannedRun, MissingScansAreNoted) {
  EXPECT_THAT(scanned().notes, testing::ElementsAre(HasSubstr("a.rawlog")));
}

TEST(MapRemoval, PointsAreKeptThatTheCloudHasWithinTenCentimetres) {
  const ScannedPoints scanned{{{0, 0, 0}, {1, 0, 0}}, {{2, 0, 0}, {3, 0, 0}}, {{4, 0, 0}}, {}};
  const MapRemoval removal = evaluateRemoval(scanned, {{0, 0.09f, 0}, {1, 0.11f, 0}, {2, 0, 0}});
  EXPECT_EQ(removal.moving.points, 2u);
  EXPECT_EQ(removal.moving.kept, 1u);
  EXPECT_EQ(removal.fixed.kept, 1u);
  EXPECT_EQ(removal.stray.points, 1u);
  EXPECT_EQ(removal.stray.kept, 0u);
}

}  // namespace
}  // namespace lamp::evaluation
