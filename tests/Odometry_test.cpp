// lamp-odometry, through the real program, on a simulated recording at full rate.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Experiment.h"
#include "Measures.h"
#include "lamp/core/Trajectory.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int kWrongUse = 2;

/** Two robots that drive 20 m each, their lidars at full rate; made once for all tests. */
class Odometry : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = freshFolder() + "/world";
    const LampResult end = runSimulator(
        {"demo", "--seed", "5", "--raw", "--out", world_, "--set", "world.start_interval_s=5",
         "--set", "world.truth_spacing_m=0.5", "--set", "world.loop_pairs=10", "--set",
         "robot.alpha.length_m=20", "--set", "robot.bravo.length_m=20"});
    ASSERT_EQ(end.exit_code, 0) << end.err;
  }
  static std::vector<StampedPose> truth(const std::string& robot) {
    return readTum(world_ + "/truth/" + robot + ".tum");
  }

  const Experiment experiment_;
  static std::string world_;
};

std::string Odometry::world_;

TEST_F(Odometry, TrajectoriesPictureAndKeyNodesForLampSlam) {
  const LampResult end = runOdometry(
      {world_ + "/alpha.rawlog", world_ + "/bravo.rawlog", "--out", experiment_.path("odometry")});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, AllOf(HasSubstr("alpha: "), HasSubstr("bravo: "),
                             HasSubstr("scans placed by lidar odometry"),
                             HasSubstr("times as fast as it was recorded")));
  const FinishedRun odometry = experiment_.result("odometry");
  for (const char* robot : {"alpha", "bravo"}) {
    const auto trajectory = odometry.trajectory(robot);
    EXPECT_GT(trajectory.size(), 0.95 * static_cast<double>(truth(robot).size()));
    EXPECT_LT(ateFromFirst(trajectory, truth(robot)), 0.1) << robot;
  }
  EXPECT_THAT(readFile(odometry.folder().mapStem(0) + ".png"), StartsWith("\x89PNG"));

  const LampResult slam =
      experiment_.run({experiment_.file("keyed.ini", iniFor3d("", "keyed = true\n")),
                       odometry.folder().keyNodes("alpha")});
  ASSERT_EQ(slam.exit_code, 0) << slam.err;
  EXPECT_EQ(experiment_.result().keyNodes("alpha").size(), odometry.keyNodes("alpha").size());
  EXPECT_LT(ateFromFirst(experiment_.result().keyNodes("alpha"), truth("alpha")), 0.1);
}

TEST_F(Odometry, OverridesReachTheFrontEnd) {
  const LampResult end =
      runOdometry({world_ + "/alpha.rawlog", "--set", "pipeline.odometry=RecordedOdometry", "--set",
                   "frontend.key_node_distance_m=10", "--out", experiment_.path("recorded")});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.out, HasSubstr("; 0 scans placed by lidar odometry"));
  EXPECT_LE(experiment_.result("recorded").keyNodes("alpha").size(), 12u);
}

TEST(OdometryCommandLine, WrongUse) {
  EXPECT_EQ(runOdometry({}).exit_code, kWrongUse);
  const LampResult end = runOdometry({"--out", "somewhere"});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.err, HasSubstr("name a recording"));
  EXPECT_THAT(runOdometry({"--version"}).out, HasSubstr("lamp-odometry "));
}

}  // namespace
}  // namespace lamp::test
