#include "lamp/core/Trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestSupport.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using test::distance;
using test::freshFolder;
using test::thrownBy;
using testing::HasSubstr;

std::vector<StampedPose> readText(const std::string& text) {
  const std::string path = freshFolder() + "/t.tum";
  writeTextFile(path, text);
  return readTum(path);
}

TEST(Tum, ReadsBackToAMicrosecondAndAMicrometre) {
  test::Random random;
  std::vector<StampedPose> trajectory;
  for (int i = 0; i < 20; ++i) trajectory.push_back({1136125839.123456 + 0.1 * i, random.pose()});
  const auto back = readText(toTum(trajectory));
  ASSERT_EQ(back.size(), trajectory.size());
  for (size_t i = 0; i < back.size(); ++i) {
    EXPECT_NEAR(back[i].stamp, trajectory[i].stamp, 1e-6);
    EXPECT_LT(distance(back[i].pose.matrix(), trajectory[i].pose.matrix()), 1e-8);
  }
}

TEST(Tum, WritesTheColumnsOfTheFormat) {
  EXPECT_EQ(toTum({{1.5, planarPose(1, 2, 0)}}),
            "1.500000 1.000000000 2.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000\n");
  EXPECT_EQ(toTum({}), "");
}

TEST(Tum, SkipsCommentsAndSortsByStamp) {
  const auto rows =
      readText("# stamp x y z qx qy qz qw\n\n2\t9 0 0 0 0 0 1\r\n1 5 0 0 0 0 0 2 # x\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].stamp, 1);
  EXPECT_EQ(rows[0].pose.translation().x(), 5);
  EXPECT_LT(distance(rows[0].pose.linear(), Eigen::Matrix3d::Identity()), 1e-15);
  EXPECT_EQ(rows[1].pose.translation().x(), 9);
}

TEST(Tum, KeepsTheFirstOfEqualStamps) {
  const auto rows = readText("2 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n2 3 0 0 0 0 0 1\n");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].pose.translation().x(), 1);
}

TEST(Tum, MalformedRowIsNamedByFileAndLine) {
  for (const char* row :
       {"1 2 3 4 0 0 0", "1 2 3 4 0 0 0 1 9", "1 x 3 4 0 0 0 1", "1 2 3 4 0 0 0 0",
        "1 nan 3 4 0 0 0 1", "nan 2 3 4 0 0 0 1", "1 2 3 4 0 0 0 inf"})
    EXPECT_THAT(thrownBy([&] { readText("# head\n0 0 0 0 0 0 0 1\n" + std::string(row) + "\n"); }),
                HasSubstr("t.tum:3: "))
        << row;
}

TEST(Tum, EmptyAndMissingFilesAreErrors) {
  EXPECT_THAT(thrownBy([] { readText("# nothing\n"); }), HasSubstr("holds no pose"));
  EXPECT_THAT(thrownBy([] { readTum("/nowhere/t.tum"); }), HasSubstr("'/nowhere/t.tum'"));
}

TEST(TrajectoryInterpolator, InterpolatesAndClamps) {
  const TrajectoryInterpolator path(
      {{10, planarPose(0, 0, 0)}, {12, planarPose(4, 0, 0)}, {13, planarPose(4, 0, 1)}});
  EXPECT_EQ(path.begin(), 10);
  EXPECT_EQ(path.end(), 13);
  EXPECT_LT(distance(path.at(10.5).matrix(), planarPose(1, 0, 0).matrix()), 1e-12);
  EXPECT_LT(distance(path.at(12).matrix(), planarPose(4, 0, 0).matrix()), 1e-12);
  EXPECT_LT(distance(path.at(12.25).matrix(), planarPose(4, 0, 0.25).matrix()), 1e-12);
  EXPECT_LT(distance(path.at(0).matrix(), planarPose(0, 0, 0).matrix()), 1e-12);
  EXPECT_LT(distance(path.at(99).matrix(), planarPose(4, 0, 1).matrix()), 1e-12);
}

TEST(TrajectoryInterpolator, OnePoseAndNone) {
  const TrajectoryInterpolator one({{10, planarPose(1, 2, 3)}});
  EXPECT_LT(distance(one.at(11).matrix(), planarPose(1, 2, 3).matrix()), 1e-12);
  EXPECT_THROW(TrajectoryInterpolator({}), std::logic_error);
}

}  // namespace
}  // namespace lamp
