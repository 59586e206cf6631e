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
using testing::AllOf;
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

TEST(Tum, ReadsWhatSpreadsheetsAndOtherProgramsWrite) {
  for (const char* text :
       {"\xEF\xBB\xBF"
        "1.5 1 2 3 0 0 0 1\n2.5 4 5 6 0 0 0 1\n",
        "1.5,1,2,3,0,0,0,1\r\n2.5,4,5,6,0,0,0,1\r\n",
        "timestamp, tx, ty, tz, qx, qy, qz, qw\n1.5, 1, 2, 3, 0, 0, 0, 1\n2.5, 4, 5, 6, 0, 0, 0, "
        "1\n",
        "1.5;1;2;3;0;0;0;1\n2.5;4;5;6;0;0;0;1\n", "1,5;1,0;2;3;0;0;0;1\n2,5;4;5;6;0;0;0;1\n"}) {
    const auto rows = readText(text);
    ASSERT_EQ(rows.size(), 2u) << text;
    EXPECT_EQ(rows[0].stamp, 1.5) << text;
    EXPECT_LT(distance(rows[0].pose.translation(), Eigen::Vector3d(1, 2, 3)), 1e-12) << text;
    EXPECT_EQ(rows[1].stamp, 2.5) << text;
  }
}

TEST(Tum, TellsTheUnitOfStamps) {
  for (const char* stamps :
       {"1600000000.25 1600000000.5", "1600000000250 1600000000500",
        "1600000000250000 1600000000500000", "1600000000250000000 1600000000500000000"}) {
    const std::string both = stamps;
    const size_t space = both.find(' ');
    const std::string pose = " 0 0 0 0 0 0 1\n";
    const auto rows = readText(both.substr(0, space) + pose + both.substr(space + 1) + pose);
    EXPECT_NEAR(rows[0].stamp, 1600000000.25, 1e-6) << stamps;
    EXPECT_NEAR(rows[1].stamp, 1600000000.5, 1e-6) << stamps;
  }
}

TEST(Tum, StampsThatHaveLostTheirDigitsAreNotReducedToOne) {
  std::string text = "# head\n";
  for (int i = 0; i < 20; ++i) text += "1.6e+09 " + std::to_string(i) + " 0 0 0 0 0 1\n";
  EXPECT_THAT(thrownBy([&] { readText(text); }),
              AllOf(HasSubstr("t.tum:3: "), HasSubstr("with all their digits")));
}

TEST(Tum, WhatIsNoTumFileIsRefusedWithTheCure) {
  EXPECT_THAT(thrownBy([] { readText("PK\x03\x04whatever"); }), HasSubstr("spreadsheet"));
  EXPECT_THAT(thrownBy([] {
                readText(
                    "\xFF\xFE"
                    "1");
              }),
              HasSubstr("UTF-8"));
  EXPECT_THAT(thrownBy([] { readText("t,x,y,z,qw,qx,qy,qz\n1,2,3,4,1,0,0,0\n"); }),
              AllOf(HasSubstr("t.tum:1: "), HasSubstr("order the columns")));
  EXPECT_THAT(thrownBy([] { readText("1 2 3 4 0 0 0\n"); }), HasSubstr("has 7 columns"));
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
