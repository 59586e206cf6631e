#include "lamp/evaluation/Relations.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestRuns.h"

namespace lamp::evaluation {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(Relations, ErrorsOfKnownSizeShortAndLongApart) {
  const Path path = straightPath(101, 0.1);  // 10 s
  // Off by 3 cm and 4 cm; by 30 degrees.
  const std::vector<Relation> relations = {
      {100.0, 101.0, pose(1.03, 0, 0)},
      {102.0, 102.5, pose(0.5, 0, -0.04)},
      {100.0, 110.0, pose(10, 0, 0, 30 * kDegree)},
  };
  const RelationErrors errors = relationErrors(path, relations);
  EXPECT_EQ(errors.below_5_s.translation_m.count, 2u);
  EXPECT_NEAR(errors.below_5_s.translation_m.mean, 0.035, 1e-9);
  EXPECT_NEAR(errors.below_5_s.translation_m.std, 0.005, 1e-9);
  EXPECT_NEAR(errors.below_5_s.rotation_deg.max, 0, 1e-9);
  EXPECT_EQ(errors.from_5_s.translation_m.count, 1u);
  EXPECT_NEAR(errors.from_5_s.rotation_deg.mean, 30, 1e-9);
  EXPECT_NEAR(errors.all.translation_m.mean, 0.07 / 3, 1e-9);
  EXPECT_NEAR(errors.all.rotation_deg.std, 30 * std::sqrt(2.0) / 3, 1e-9);
}

TEST(Relations, DoNotDependOnTheFrameOfTheTrajectory) {
  const std::vector<Relation> relations = {{100.0, 101.0, pose(1.03, 0.1, 0, 0.2)}};
  const Path path = windingPath(50);
  EXPECT_NEAR(
      relationErrors(path, relations).all.translation_m.mean,
      relationErrors(moved(path, pose(7, 8, 9, 1, 0.2, 0.3)), relations).all.translation_m.mean,
      1e-9);
}

TEST(Relations, WithoutPoseAreCountedAndNoneAtAllIsAnError) {
  const Path path = straightPath(50, 0.1);
  const Relation known{100, 101, pose(1, 0, 0)}, unknown{90, 101, pose(1, 0, 0)};
  const RelationErrors errors = relationErrors(path, {known, unknown});
  EXPECT_EQ(errors.all.translation_m.count, 1u);
  EXPECT_EQ(errors.without_pose, 1u);
  EXPECT_THAT(thrownBy([&] { relationErrors(path, {unknown}); }),
              HasSubstr("no relation is between two scans of the run"));
}

TEST(Relations, ReadsRollPitchYawAndNamesMalformedRows) {
  const std::string path = freshFolder() + "/r.relations";
  writeTextFile(path, "# from to x y z roll pitch yaw\n1.5 2.5 1 2 3 0.1 0.2 0.3\n\n");
  const auto relations = readRelations(path);
  ASSERT_EQ(relations.size(), 1u);
  EXPECT_EQ(relations[0].from, 1.5);
  EXPECT_EQ(relations[0].to, 2.5);
  EXPECT_LT((relations[0].from_T_to.matrix() - pose(1, 2, 3, 0.3, 0.2, 0.1).matrix()).norm(),
            1e-12);
  for (const char* row : {"1 2 3", "1 2 3 4 5 6 7 nan", "1 2 3 4 5 6 7 x"}) {
    writeTextFile(path, std::string("1 2 0 0 0 0 0 0\n") + row + "\n");
    EXPECT_THAT(thrownBy([&] { readRelations(path); }), HasSubstr("r.relations:2")) << row;
  }
  writeTextFile(path, "# none\n");
  EXPECT_THAT(thrownBy([&] { readRelations(path); }), HasSubstr("holds no"));
}

TEST(Relations, StampsOfTheRecordingBecomeThoseOfTheRelations) {
  const std::string path = freshFolder() + "/stamps.txt";
  writeTextFile(path, "# n theirs ours\n0 7.5 100.0\n1 7.9 100.05\n2 8.25 100.1\n");
  const Path mapped = withRelationStamps(straightPath(2, 1), path);
  EXPECT_EQ(mapped[0].stamp, 7.5);
  EXPECT_EQ(mapped[1].stamp, 8.25) << "the scan between has no pose and is skipped";
  EXPECT_THAT(thrownBy([&] { withRelationStamps(straightPath(3, 1), path); }),
              testing::AllOf(HasSubstr("stamps.txt"), HasSubstr("100.2")));
}

}  // namespace
}  // namespace lamp::evaluation
