#include "lamp/simulation/SimConfig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "SmallMission.h"

namespace lamp::simulation {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string faultsOf(const std::string& kind, const std::string& ini) {
  try {
    configOf(kind, ini);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(SimConfig, IsThePapersTeamByDefault) {
  const SimConfig config = configOf("ku", "");
  ASSERT_EQ(config.robots.size(), 4u);
  EXPECT_EQ(config.robots[0].name, "husky1");
  EXPECT_EQ(config.robots[0].lidars, (std::vector<std::string>{"top", "front", "rear"}));
  EXPECT_EQ(config.robots[2].lidars, (std::vector<std::string>{"hovermap"}));
  EXPECT_NEAR(config.totalLength(), 6300, 10);
  EXPECT_NEAR(config.robots[3].odometry.min_ate_m, 5.49, 1e-9);
  EXPECT_EQ(config.lidars.at("hovermap").model, "rotating_mount");
}

TEST(SimConfig, DistanceScaleShrinksWaysAndErrors) {
  const SimConfig config = configOf("ku", "[world]\ndistance_scale = 0.1\n");
  EXPECT_NEAR(config.totalLength(), 630, 1);
  EXPECT_NEAR(config.robots[3].odometry.min_ate_m, 0.549, 1e-9);
}

TEST(SimConfig, LargerTeamsRepeatThePapersRobotsUnderNamesOfTheirOwn) {
  for (const int count : {1, 5, 16}) {
    const SimConfig config =
        configOf("tunnel", "[world]\nrobots = " + std::to_string(count) + "\n");
    std::set<std::string> names;
    for (const SimulatedRobotOptions& robot : config.robots) names.insert(robot.name);
    EXPECT_EQ(names.size(), static_cast<size_t>(count));
  }
  const SimConfig five = configOf("tunnel", "[world]\nrobots = 5\n");
  EXPECT_EQ(five.robots[4].name, "husky3_3");
  EXPECT_EQ(five.robots[4].length_m, five.robots[0].length_m);
}

TEST(SimConfig, SectionsOfARobotGoOverThoseOfAll) {
  const SimConfig config = configOf("tunnel", R"(
[drive]
speed_mps = 2
wander_m = 0.1
[drive.husky4]
speed_mps = 0.5
[odometry]
covariance_factor = 10
[robot.husky4]
length_m = 77
lidars = hovermap, mine
[lidar.mine]
rate_hz = 5
)");
  EXPECT_EQ(config.robots[0].drive.speed_mps, 2);
  EXPECT_EQ(config.robots[1].drive.speed_mps, 0.5);
  EXPECT_EQ(config.robots[1].drive.wander_m, 0.1);
  EXPECT_EQ(config.robots[0].odometry.covariance_factor, 10);
  EXPECT_EQ(config.robots[0].odometry.min_ate_m, 1.07) << "the paper's stays";
  EXPECT_EQ(config.robots[1].length_m, 77);
  EXPECT_EQ(config.robots[1].lidars, (std::vector<std::string>{"hovermap", "mine"}));
  EXPECT_EQ(config.lidars.at("mine").rate_hz, 5);
}

TEST(SimConfig, ItsTextReadsBackToTheSame) {
  for (const WorldKind& kind : worldKinds()) {
    const std::string text = configOf(kind.name, R"(
[world]
robots = 6
distance_scale = 0.3
[drive]
speed_mps = 0.7
[keyed]
max_points = 777
[imu]
rate_hz = 50
[radio]
range_m = 33
[link]
range_m = 44
[artifacts]
range_m = 7
[lidar.own]
pose = [1 2 3 4 5 6]
)")
                                 .text();
    EXPECT_EQ(configOf(kind.name, text).text(), text) << kind.name;
    for (const char* value : {"speed_mps = 0.7", "max_points = 777", "rate_hz = 50", "range_m = 33",
                              "range_m = 44", "range_m = 7", "[lidar.own]"})
      EXPECT_THAT(text, HasSubstr(value)) << kind.name;
  }
}

TEST(SimConfig, AllFaultsAreListedAtOnce) {
  const std::string faults = faultsOf("tunnel", R"([world]
robots = 17
distnce_scale = 1
[keyed]
max_points = many
[wrold]
[drive.husky5]
[robot.husky3]
lidars = top, bottom
[odometry]
scale_sgima = 1
)");
  EXPECT_THAT(faults, AllOf(HasSubstr("test.ini:2: [world] robots = 17"),
                            HasSubstr("test.ini:3: [world] has no key 'distnce_scale'"),
                            HasSubstr("test.ini:5: [keyed] max_points = many"),
                            HasSubstr("test.ini:6: there is no section [wrold]"),
                            HasSubstr("test.ini:11: [odometry] has no key 'scale_sgima'"),
                            HasSubstr("[lidar.bottom]")));
}

TEST(SimConfig, SectionsOfRobotsThatAreNotThereAreFaults) {
  EXPECT_THAT(faultsOf("tunnel", "[robot.husky5]\n[drive.huskyy4]\n[odometry.husky3]\n"),
              AllOf(HasSubstr("test.ini:1: there is no section [robot.husky5]"),
                    HasSubstr("test.ini:2: there is no section [drive.huskyy4] (did you mean "
                              "'drive.husky4'?)"),
                    Not(HasSubstr("test.ini:3"))));
  EXPECT_EQ(faultsOf("tunnel", "[world]\nrobots = 3\n[robot.husky3_2]\n"), "");
}

TEST(SimConfig, AFaultyTeamSizeDoesNotAccuseTheRobotsSections) {
  EXPECT_THAT(faultsOf("tunnel", "[world]\nrobots = 1x\n[robot.husky3_2]\nlength_m = 50\n"),
              AllOf(HasSubstr("robots = 1x"), Not(HasSubstr("husky3_2"))));
}

TEST(SimConfig, EachFaultIsListedOnce) {
  const std::string faults = faultsOf("ku", "[drive]\nsped_mps = 1\n[lidar.top]\nrate_hz = -1\n");
  for (const std::string word : {"sped_mps", "rate_hz"})
    EXPECT_EQ(faults.find(word), faults.rfind(word + (word == "rate_hz" ? " = -1" : "'")))
        << faults;
}

TEST(SimConfig, ARobotNeedsALidar) {
  EXPECT_THAT(faultsOf("demo", "[robot.alpha]\nlidars =\n"),
              AllOf(HasSubstr("[robot.alpha]"), HasSubstr("lidars")));
}

}  // namespace
}  // namespace lamp::simulation
