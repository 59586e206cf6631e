// The command line and the experiment file, through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "Experiment.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr int kFailed = 1, kWrongUse = 2;

TEST(CommandLine, WithoutArgumentsSaysWhatToDo) {
  const LampResult end = runLamp({});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.out, IsEmpty());
  EXPECT_THAT(end.err, AllOf(HasSubstr("--out DIR"), HasSubstr("--help")));
}

TEST(CommandLine, HelpNamesAllOptions) {
  const LampResult end = runLamp({"--help"});
  EXPECT_EQ(end.exit_code, 0);
  for (const char* option : {"--out", "--set", "--threads", "--seed", "--log", "--list-modules",
                             "--dump-config", "--help", "--version"})
    EXPECT_THAT(end.out, HasSubstr(option));
  EXPECT_THAT(end.err, IsEmpty());
}

TEST(CommandLine, VersionIsOneLine) {
  const LampResult end = runLamp({"--version"});
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_THAT(end.out, testing::MatchesRegex("lamp-slam [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(CommandLine, ListModulesNamesTheStages) {
  const LampResult end = runLamp({"--list-modules"});
  EXPECT_EQ(end.exit_code, 0);
  for (const char* stage :
       {"RecordedOdometry", "FixedRadius", "AdaptiveRadius", "Arrival", "Gicp", "OverlapResidual",
        "OdometryGate", "Icm", "Gnc", "Lm", "Gn", "CeresLm", "OctoMap", "Picture"})
    EXPECT_THAT(end.out, HasSubstr(std::string("  ") + stage + "\n"));
}

TEST(CommandLine, UnknownOptionsAndValuesAreWrongUse) {
  const Experiment experiment;
  const std::string ini = experiment.file("empty.ini", "");
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--outt", "x"},
                                                {"--threads", "0"},
                                                {"--threads", "two"},
                                                {"--seed", "-1"},
                                                {"--log", "LOUD"},
                                                {"--set"}}) {
    std::vector<std::string> arguments = {ini};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const LampResult end = runLamp(arguments);
    EXPECT_EQ(end.exit_code, kWrongUse) << wrong[0];
    EXPECT_THAT(end.err, HasSubstr(wrong[0]));
  }
}

TEST(CommandLine, NeedsAFolderForTheResults) {
  const Experiment experiment;
  const LampResult end = runLamp({experiment.file("empty.ini", ""), "any.rawlog"});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.err, HasSubstr("--out DIR"));
}

TEST(CommandLine, MissingIni) {
  const Experiment experiment;
  const LampResult end = experiment.run({experiment.path("not-there.ini"), "any.rawlog"});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(experiment.path("not-there.ini")));
}

TEST(CommandLine, AllFaultsOfAnIniAreListedAtOnce) {
  const Experiment experiment;
  const std::string ini = experiment.file("faulty.ini", R"([frontend]
key_node_distnce_m = 2
max_range_m = 12x
min_range_m = 1
min_range_m = 2

[pipeline]
optimizer = Gnnc
inter_robot_loops = maybe
[frontent]
[base_station]
max_attempts = 0
this line is nothing
[robot.A]
start_pose = [1 2 3]
[lamp::NoSuchStage]
)");
  const LampResult end = experiment.run({ini, "any.rawlog", "--set", "run.sed=3"});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_FALSE(experiment.result().has(""));
  EXPECT_THAT(end.err, AllOf(HasSubstr(ini + ":5: key 'min_range_m' appears twice"),
                             HasSubstr("first at " + ini + ":4"),
                             HasSubstr(ini + ":13: 'this line is nothing'")));
  EXPECT_THAT(end.err,
              AllOf(HasSubstr(ini + ":2: [frontend] has no key 'key_node_distnce_m' (did you mean "
                                    "'key_node_distance_m'?)"),
                    HasSubstr(ini + ":3: [frontend] max_range_m = 12x: is not a number"),
                    HasSubstr(ini + ":8: [pipeline] optimizer: there is no optimizer 'Gnnc' (did "
                                    "you mean 'Gnc'?); known: CeresLm, Gn, Gnc, Lm"),
                    HasSubstr(ini + ":9: [pipeline] inter_robot_loops = maybe: must be true or"),
                    HasSubstr(ini + ":10: there is no section [frontent]"),
                    HasSubstr(ini + ":12: [base_station] max_attempts = 0: must be at least 1"),
                    HasSubstr(ini + ":15: [robot.A] start_pose = [1 2 3]: needs 6 numbers"),
                    HasSubstr(ini + ":16: there is no stage 'NoSuchStage'"),
                    HasSubstr("--set run.sed=3: [run] has no key 'sed' (did you mean 'seed'?)")));
}

/** Else it would be taken for another override. */
TEST(CommandLine, WhatFollowsAnOverrideIsARecording) {
  const Experiment experiment;
  const LampResult end =
      experiment.run({experiment.file("empty.ini", ""), "--set", "run.seed=1", "--set",
                      "run.seed=2", experiment.path("first.rawlog"), experiment.path("b.rawlog")});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(experiment.path("first.rawlog") + ": no such file"));
  const LampResult registered =
      runRegister({"--set", "run.seed=1", experiment.path("a.pcd"), experiment.path("b.pcd")});
  EXPECT_THAT(registered.err, HasSubstr("cannot read '" + experiment.path("a.pcd") + "'"));
  const LampResult simulated = runSimulator({"--set", "world.robots=2", "no-such-world"});
  EXPECT_THAT(simulated.err, HasSubstr("no-such-world"));
}

TEST(CommandLine, MalformedOverride) {
  const Experiment experiment;
  const LampResult end = experiment.run({experiment.file("empty.ini", ""), "--set", "novalue"});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.err, AllOf(HasSubstr("novalue"), HasSubstr("section.key=value")));
}

TEST(CommandLine, RobotsThatClashInTheIni) {
  const Experiment experiment;
  const std::string ini = experiment.file("clash.ini", R"([robot.one]
key = x
[robot.two]
key = x
[robot.not a name]
[robot.one]
)");
  const LampResult end = experiment.run({ini, "any.rawlog"});
  EXPECT_EQ(end.exit_code, kWrongUse);
  EXPECT_THAT(end.err, HasSubstr(ini + ":6: section [robot.one] appears twice"));
  EXPECT_THAT(end.err, HasSubstr(ini + ":3: robot 'two': the key 'x' is taken"));
  EXPECT_THAT(end.err, HasSubstr(ini + ":5: robot name 'not a name'"));
}

TEST(CommandLine, MissingPluginIsNamed) {
  const Experiment experiment;
  const LampResult end = experiment.run(
      {experiment.file("plugin.ini", "[plugins]\nload = libnot-there.so\n"), "any.rawlog"});
  EXPECT_NE(end.exit_code, 0);
  EXPECT_THAT(end.err, HasSubstr("libnot-there.so"));
}

class ShippedIni : public testing::TestWithParam<const char*> {};

TEST_P(ShippedIni, DumpIsAFixedPoint) {
  const std::string ini = std::string(LAMP_SOURCE_DIR "/ini/") + GetParam();
  const LampResult first = runLamp({ini, "--dump-config", "--set", "run.seed=42"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(first.err, IsEmpty());
  EXPECT_THAT(first.out, HasSubstr("seed = 42\n"));
  EXPECT_THAT(first.out, Not(HasSubstr("threads")));
  const Experiment experiment;
  const LampResult second = runLamp({experiment.file("dump.ini", first.out), "--dump-config"});
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, first.out);
}

INSTANTIATE_TEST_SUITE_P(Ini, ShippedIni,
                         testing::Values("default.ini", "sena.ini", "balm_indoor.ini", "aces.ini"),
                         [](const auto& ini) {
                           const std::string name = ini.param;
                           return name.substr(0, name.find('.'));
                         });

}  // namespace
}  // namespace lamp::test
