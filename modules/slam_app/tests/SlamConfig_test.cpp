#include "lamp/slam_app/SlamConfig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "TemporaryFolder.h"
#include "TestTeam.h"
#include "lamp/core/Files.h"
#include "lamp/frontend/OdometrySource.h"
#include "lamp/maps/MapExporter.h"
#include "lamp/registration/InitialAligner.h"
#include "lamp/registration/OverlapResidual.h"
#include "lamp/scans/Cloud.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/** What is wrong with an ini, one line a fault; empty if nothing is. */
std::string faultsOf(const std::string& text) {
  try {
    configFrom(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

/** An ini file of the running test's own. */
std::string iniFile(const std::string& text) {
  const std::string path = test::freshFolder() + "/wrong.ini";
  writeTextFile(path, text);
  return path;
}

TEST(SlamConfig, AnEmptyIniGivesTheDefaults) {
  const SlamConfig config = configFrom("");
  EXPECT_EQ(config.make<CandidateGenerator>().size(), 3u);
  EXPECT_EQ(config.make<CandidateGenerator>()[0]->getLoggerName(), "AdaptiveRadius");
  EXPECT_EQ(config.makeOne<Refiner>()->getLoggerName(), "Gicp");
  EXPECT_EQ(config.make<InitialAligner>().size(), 3u);
  EXPECT_EQ(config.make<Verifier>().size(), 4u);
  EXPECT_EQ(config.make<MapExporter>().size(), config.pipeline.exporters.size());
  EXPECT_TRUE(config.robots.empty());
  EXPECT_NE(config.makeOne<OdometrySource>(), config.makeOne<OdometrySource>())
      << "one for each robot";
}

TEST(SlamConfig, ReportsAllFaultsOfAFileAtOnceWithTheirLines) {
  registerAllClasses_lamp();
  const std::string path = iniFile(
      "[pipeline]\n"
      "verifiers = OverlapResidual, Nonsense\n"  // 2
      "optimizer = Gncc\n"                       // 3
      "priority =\n"                             // 4
      "[frontend]\n"                             //
      "key_node_distanc_m = 2\n"                 // 6
      "key_node_angle_deg = -3\n"                // 7
      "this line is nothing\n"                   // 8
      "[base_station]\n"                         //
      "closures_per_round = many\n"              // 10
      "[lamp::Lm]\n"                             // takes no part
      "max_iterations = none\n"                  // 12
      "[fronted]\n"                              // 13
      "[lamp::NoSuchStage]\n"                    // 14
      "[robot.B]\n"                              //
      "start_pose = [1 2 3]\n"                   // 16
      "key = c\n"                                //
      "[robot.C]\n"                              // 18
      "key = c\n");
  try {
    SlamConfig::fromFile(path, {"base_station.max_attempts=0", "nonsense"});
    FAIL() << "must not be accepted";
  } catch (const ConfigError& error) {
    const std::string faults = error.what();
    EXPECT_THAT(
        faults,
        HasSubstr(path + ":2: [pipeline] verifiers: there is no verifier "
                         "'Nonsense'; known: BothDirections, "
                         "FreeSpaceConsistency, GuessDeviation, OverlapResidual, PclFitness"));
    EXPECT_THAT(faults, HasSubstr(path + ":3: [pipeline] optimizer: there is no optimizer 'Gncc' "
                                         "(did you mean 'Gnc'?)"));
    EXPECT_THAT(faults, HasSubstr(path + ":4: [pipeline] priority: needs a name"));
    EXPECT_THAT(faults, HasSubstr(path + ":6: [frontend] has no key 'key_node_distanc_m' (did you "
                                         "mean 'key_node_distance_m'?)"));
    EXPECT_THAT(faults, HasSubstr(path + ":7: [frontend] key_node_angle_deg = -3"));
    EXPECT_THAT(faults, HasSubstr(path + ":8: 'this line is nothing'"));
    EXPECT_THAT(faults, HasSubstr(path + ":10: [base_station] closures_per_round = many"));
    EXPECT_THAT(faults, HasSubstr(path + ":12: [lamp::Lm] max_iterations = none"));
    EXPECT_THAT(faults, HasSubstr(path + ":13: there is no section [fronted] (did you mean "
                                         "'frontend'?)"));
    EXPECT_THAT(faults, HasSubstr(path + ":14: there is no stage 'NoSuchStage'"));
    EXPECT_THAT(faults, HasSubstr(path + ":16: [robot.B] start_pose"));
    EXPECT_THAT(faults, HasSubstr(path + ":18: "));
    EXPECT_THAT(faults, HasSubstr("max_attempts = 0"));
    EXPECT_THAT(faults, HasSubstr("--set: 'nonsense'"));
    EXPECT_EQ(std::count(faults.begin(), faults.end(), '\n') + 1, 14) << faults;
  }
}

TEST(SlamConfig, ChecksStagesThatTakeNoPartOnce) {
  EXPECT_THAT(faultsOf("[lamp::PointToPlane]\nmax_iterations = 0\n"),
              AllOf(HasSubstr("test.ini:2"), Not(HasSubstr("\n"))));
  EXPECT_THAT(faultsOf("[lamp::Gicp]\nmax_iterations = 0\n"),
              AllOf(HasSubstr("test.ini:2"), Not(HasSubstr("\n"))));
  EXPECT_THAT(faultsOf("[lamp::OverlapResidual@strict]\nmin_overlap = 2\n"),
              AllOf(HasSubstr("test.ini:2"), Not(HasSubstr("\n"))));
  EXPECT_EQ(faultsOf("[lamp::OverlapResidual@strict]\nmin_overlap = 0.9\n"), "");
}

TEST(SlamConfig, AStageOfAnotherKindIsNoAnswer) {
  EXPECT_THAT(faultsOf("[pipeline]\nrefiner = OverlapResidual\n"),
              HasSubstr("there is no refiner 'OverlapResidual'"));
}

TEST(SlamConfig, StagesOfWhatRunsOnItsOwnAreItsOwn) {
  const SlamConfig config = configFrom("[pipeline]\noutlier_rejection = Icm\n");
  const BaseStationSetup one = config.makeBaseStationSetup(), two = config.makeBaseStationSetup();
  EXPECT_NE(one.back_end.optimizer, two.back_end.optimizer);
  EXPECT_NE(one.back_end.rejections.at(0), two.back_end.rejections.at(0));
}

TEST(SlamConfig, FormerNamesOfAlignersAreStillFound) {
  EXPECT_EQ(configFrom("[pipeline]\ninitial_aligner = Identity, Odometry\n").text(),
            configFrom("[pipeline]\ninitial_aligner = IdentityGuess, OdometryGuess\n").text());
}

TEST(SlamConfig, OneOptimizerIsEnough) {
  EXPECT_THAT(faultsOf("[pipeline]\noptimizer = Lm, Gnc\n"),
              HasSubstr("optimizer: takes one name, not 2"));
}

TEST(SlamConfig, InstancesOfOneClassHaveTheirOwnSections) {
  const SlamConfig config = configFrom(
      "[pipeline]\nverifiers = OverlapResidual, OverlapResidual@strict\n"
      "[lamp::OverlapResidual]\nmin_overlap = 0.3\n"
      "[lamp::OverlapResidual@strict]\nmin_overlap = 0.8\n");
  const auto verifiers = config.make<Verifier>();
  ASSERT_EQ(verifiers.size(), 2u);
  const auto overlap = [&](size_t i) {
    return std::dynamic_pointer_cast<OverlapResidual>(verifiers[i])->options.min_overlap;
  };
  EXPECT_EQ(overlap(0), 0.3);
  EXPECT_EQ(overlap(1), 0.8);
  EXPECT_EQ(verifiers[1]->getLoggerName(), "OverlapResidual@strict");
}

TEST(SlamConfig, TextReadsBackToTheSameText) {
  const std::string changed =
      "[run]\nseed = 77\n"
      "[input]\nrawlogs = /data/one.rawlog, /data/two words.rawlog\norder = arrival\n"
      "[pipeline]\ncandidates =\nverifiers = GuessDeviation, OverlapResidual, "
      "OverlapResidual@strict\ninter_robot_loops = no\nexporters = Ply\n"
      "[frontend]\nkeyed = true\nkey_node_distance_m = 1.2345678901234567\n"
      "[base_station]\noptimize_growth = 0.1\n"
      "[lamp::OverlapResidual@strict]\nmin_overlap = 0.8\n"
      "[lamp::Gicp]\nkernel_m = 0.123\n"
      "[robot.husky-1]\nrawlog = husky.rawlog\nstart_pose = [1 2 3 90 0 -0.5]\nkey = h\n"
      "arrivals = husky.arrivals.csv\n"
      "[robot.spot]\nlidar_labels = front, rear\narrivals = spot.csv\n";
  for (const std::string& ini : {std::string(), changed}) {
    const std::string text = configFrom(ini).text();
    EXPECT_EQ(configFrom(text).text(), text);
  }
  const SlamConfig config = configFrom(configFrom(changed).text());
  EXPECT_EQ(config.run.seed, 77);
  EXPECT_THAT(config.input.rawlogs, ElementsAre("/data/one.rawlog", "/data/two words.rawlog"));
  EXPECT_TRUE(config.input.inArrivalOrder());
  EXPECT_THAT(config.make<CandidateGenerator>(), IsEmpty());
  EXPECT_FALSE(config.pipeline.inter_robot_loops);
  EXPECT_TRUE(config.frontend.keyed);
  EXPECT_EQ(config.frontend.key_node_distance_m, 1.2345678901234567);
  ASSERT_EQ(config.robots.size(), 2u);
  EXPECT_EQ(config.robots[0].name, "husky-1");
  EXPECT_THAT(config.robots[0].start_pose, ElementsAre(1, 2, 3, 90, 0, -0.5));
  EXPECT_EQ(config.robots[0].arrivals, "husky.arrivals.csv");
  EXPECT_THAT(config.robots[1].lidar_labels, ElementsAre("front", "rear"));
  const auto strict = std::dynamic_pointer_cast<OverlapResidual>(config.make<Verifier>()[2]);
  EXPECT_EQ(strict->options.min_overlap, 0.8);
}

TEST(SlamConfig, TextHoldsEveryUsedStageOnce) {
  const std::string text =
      configFrom("[pipeline]\nverifiers = GuessDeviation, GuessDeviation\n").text();
  for (const char* section :
       {"[plugins]", "[run]", "[input]", "[pipeline]", "[frontend]", "[registration]",
        "[base_station]", "[refinement]", "[lamp::RecordedOdometry]", "[lamp::AdaptiveRadius]",
        "[lamp::Arrival]", "[lamp::OdometryGuess]", "[lamp::Gicp]", "[lamp::GuessDeviation]",
        "[lamp::Gnc]", "[lamp::Ply]"}) {
    const size_t first = text.find(section);
    EXPECT_NE(first, std::string::npos) << section;
    EXPECT_EQ(text.find(section, first + 1), std::string::npos) << section;
  }
  EXPECT_THAT(text, Not(HasSubstr("[lamp::Lm]")));
}

TEST(SlamConfig, OverridesWin) {
  registerAllClasses_lamp();
  const std::string path = iniFile("[base_station]\nmax_attempts = 2\n");
  const SlamConfig config = SlamConfig::fromFile(
      path, {"base_station.max_attempts=7", "lamp::OverlapResidual.min_overlap=0.25"});
  EXPECT_EQ(config.base_station.max_attempts, 7);
  EXPECT_THAT(config.text(), HasSubstr("min_overlap = 0.25"));
}

TEST(SlamConfig, AKeyIsOneFreeLetter) {
  EXPECT_THAT(faultsOf("[robot.A]\nkey = ab\n"), HasSubstr("test.ini"));
  EXPECT_THAT(faultsOf("[robot.A]\nkey = +\n"), HasSubstr("test.ini"));
  EXPECT_THAT(faultsOf("[robot.A]\nkey = b\n[robot.B]\nkey = b\n"), HasSubstr("test.ini:3"));
  EXPECT_THAT(faultsOf("[robot.not a name]\n"), HasSubstr("test.ini:1"));
}

TEST(SlamConfig, TheOrderOfArrivalNeedsTheArrivalsOfEachRobot) {
  EXPECT_THAT(faultsOf("[input]\norder = late\n"), HasSubstr("test.ini:2: [input] order = late"));
  EXPECT_EQ(faultsOf("[input]\norder = recorded\n[robot.A]\n"), "");
  EXPECT_THAT(faultsOf("[run]\n[input]\norder = arrival\n"),
              AllOf(HasSubstr("test.ini:3"), HasSubstr("arrivals = FILE.csv for each robot")));
  EXPECT_THAT(
      faultsOf("[input]\norder = arrival\n[robot.A]\n[robot.B]\narrivals = b.csv\n"
               "[robot.C]\n"),
      AllOf(HasSubstr("test.ini:3: [robot.A] arrivals: is missing"),
            HasSubstr("test.ini:6: [robot.C] arrivals: is missing"), Not(HasSubstr("robot.B"))));
}

TEST(SlamConfig, APluginThatDoesNotLoadIsNamed) {
  try {
    configFrom("[plugins]\nload = libnowhere_to_be_found.so\n");
    FAIL() << "must not be accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("libnowhere_to_be_found.so"));
  }
}

TEST(SlamConfig, AFileThatIsNotThereIsNamed) {
  try {
    SlamConfig::fromFile("/nowhere/at_all.ini", {});
    FAIL() << "must not be accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/at_all.ini"));
  }
}

TEST(SlamConfig, TheInisOfTheProjectAreRight) {
  registerAllClasses_lamp();
  size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(LAMP_SOURCE_DIR "/ini")) {
    if (entry.path().extension() != ".ini") continue;
    EXPECT_NO_THROW(SlamConfig::fromFile(entry.path().string(), {})) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0u);
}

TEST(SlamConfig, AGateNeedsPlatesThatTellAPose) {
  EXPECT_NO_THROW(configFrom("[gate]\nplates = [0 0 0 1 0 0 2 0 0]\n[robot.A]\n")) << "not used";
  for (const char* const plates : {"", "plates = [0 0 0 1 0 0 2 0 0]\n"})
    EXPECT_THROW(configFrom(std::string("[gate]\n") + plates + "[robot.A]\ncalibration = gate\n"),
                 ConfigError);
}

TEST(SlamConfig, TheDefaultIniHoldsTheDefaults) {
  EXPECT_THAT(readTextFile(LAMP_SOURCE_DIR "/ini/default.ini"),
              testing::EndsWith("\n\n" + configFrom("").text()));
}

TEST(Parameters, ThePageIsUpToDate) {
  registerAllClasses_lamp();
  EXPECT_EQ(readTextFile(LAMP_SOURCE_DIR "/docs/parameters.md"), describeParameters())
      << "docs/parameters.md is what `lamp-slam --dump-parameters` prints: make it anew";
}

TEST(Parameters, EveryStageIsListedAndDescribed) {
  registerAllClasses_lamp();
  const std::string list = listStages(), page = describeParameters();
  for (const StageKind& kind : stageKinds()) {
    EXPECT_THAT(stageClasses(kind.base), Not(IsEmpty())) << kind.name;
    for (const std::string& name : stageClasses(kind.base)) {
      EXPECT_THAT(list, HasSubstr("  " + name + "\n"));
      EXPECT_THAT(page, HasSubstr("### [lamp::" + name + "]"));
    }
  }
}

/** What SacIa makes of two views of a hall. */
Pose3 alignedBySamples(int seed) {
  const SlamConfig config =
      configFrom("[run]\nseed = " + std::to_string(seed) +
                 "\n[pipeline]\ninitial_aligner = SacIa\n[lamp::SacIa]\niterations = 3\n"
                 "min_sample_distance_m = 0\n");
  const auto prepared = [&](const Pose3& world_T_base, unsigned noise) {
    const KeyedScanPtr scan = Hall().scan(world_T_base, noise, false);
    const PreparationOptions& options = config.registration.preparation;
    return PreparedScan(accumulate({{scan, Pose3::Identity()}}, options.accumulate_voxel_m),
                        options.scan, false);
  };
  const auto source = prepared(planarPose(6, 6, 0), 1), target = prepared(planarPose(7, 6, 0.3), 2);
  const auto result = config.make<InitialAligner>().at(0)->align(source, target, Guess());
  EXPECT_EQ(result.hypotheses.size(), 1u) << result.refusal;
  return result.hypotheses.at(0).target_T_source;
}

TEST(SlamConfig, TheSeedReachesStagesThatDrawAtRandom) {
  const Pose3 one = alignedBySamples(1);
  EXPECT_TRUE(one.isApprox(alignedBySamples(1), 0));
  EXPECT_FALSE(one.isApprox(alignedBySamples(2), 1e-3));
}

}  // namespace
}  // namespace lamp
