#include "lamp/core/Ini.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "TestSupport.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

struct EngineOptions {
  double radius_m = 2.5;
  int count = 7;
  bool enabled = true;
  std::string mode = "fast";
  std::string file;
  std::vector<double> start_pose;
  std::vector<double> weights = {0.25, 0.75};
  std::vector<std::string> stages = {"One", "Two@b"};

  void visit(OptionVisitor& v) {
    v("radius_m", radius_m, "m", "search radius", kPositive);
    v("count", count, "", "how many", kNotNegative);
    v("enabled", enabled, "whether it runs");
    v("mode", mode, "how it runs", {"fast", "exact"});
    v("file", file, "where from");
    v("start_pose", start_pose, 3, "m", "where it starts");
    v("weights", weights, 0, "", "of the terms", kShare);
    v("stages", stages, "what runs");
  }
};

/** Reads a text that must have no faults. */
Ini read(const std::string& text) {
  Faults faults;
  const Ini ini = Ini::fromText(text, "t.ini", faults);
  EXPECT_THAT(faults.list(), IsEmpty());
  return ini;
}

std::string value(const Ini& ini, const std::string& section, const std::string& key) {
  const Ini::Section* found = ini.find(section);
  const Ini::Entry* entry = found ? found->find(key) : nullptr;
  return entry ? entry->value : "(missing)";
}

/** The faults of a text, those of its form alone. */
std::vector<std::string> faultsOf(const std::string& text) {
  Faults faults;
  Ini::fromText(text, "t.ini", faults);
  return faults.list();
}

/** Reads `[engine]` with one line in it and gives the only fault. */
std::string optionFault(const std::string& line) {
  Faults faults;
  const Ini ini = Ini::fromText("[engine]\n" + line + "\n", "t.ini", faults);
  EngineOptions options;
  readOptions(ini.find("engine"), options, faults);
  return faults.list().size() == 1 ? faults.list()[0]
                                   : std::to_string(faults.list().size()) + " faults";
}

EngineOptions readEngine(const std::string& lines) {
  const Ini ini = read("[engine]\n" + lines);
  Faults faults;
  EngineOptions options;
  readOptions(ini.find("engine"), options, faults);
  EXPECT_THAT(faults.list(), IsEmpty());
  return options;
}

TEST(Ini, ReadsSectionsAndKeysInOrder) {
  const Ini ini = read("[b]\n y = 2 \n\tx=1\n[ lamp::A@left ]\nx = p = q\nempty =\n");
  ASSERT_EQ(ini.sections().size(), 2u);
  EXPECT_EQ(ini.sections()[0].name, "b");
  EXPECT_EQ(ini.sections()[0].entries[0].key, "y");
  EXPECT_EQ(ini.sections()[0].entries[0].where, "t.ini:2");
  EXPECT_EQ(value(ini, "b", "x"), "1");
  EXPECT_EQ(value(ini, "lamp::A@left", "x"), "p = q");
  EXPECT_EQ(value(ini, "lamp::A@left", "empty"), "");
  EXPECT_EQ(ini.find("nope"), nullptr);
}

TEST(Ini, SkipsComments) {
  const Ini ini =
      read("// a\n; b\n# c\n  // d\n[s] // e\nx = 1 // f\ny = http://h//i\nz = a\t//j\n");
  EXPECT_EQ(ini.find("s")->entries.size(), 3u);
  EXPECT_EQ(value(ini, "s", "x"), "1");
  EXPECT_EQ(value(ini, "s", "y"), "http://h//i");
  EXPECT_EQ(value(ini, "s", "z"), "a");
}

TEST(Ini, ContinuesLines) {
  const Ini ini = read("[s]\nx = 1 \\\n    2 \\  // two\n  3\nlast = a \\\n");
  EXPECT_EQ(value(ini, "s", "x"), "1 2 3");
  EXPECT_EQ(ini.find("s")->find("x")->where, "t.ini:2");
  EXPECT_EQ(ini.find("s")->find("last")->where, "t.ini:5");
  EXPECT_EQ(value(ini, "s", "last"), "a");
}

TEST(Ini, ReadsDosLineEnds) {
  EXPECT_EQ(value(read("[s]\r\nx = 1\r\n"), "s", "x"), "1");
}

TEST(Ini, ReplacesDefinesAndEnvironment) {
  ::setenv("LAMP_INI_TEST", "from env", 1);
  const Ini ini = read(
      "@define R 12.5 // metres\n@define RR ${R}0\n[s]\nx = ${R}\ny = <${RR}|$env{LAMP_INI_TEST}>\n"
      "z = 5$\n");
  EXPECT_EQ(value(ini, "s", "x"), "12.5");
  EXPECT_EQ(value(ini, "s", "y"), "<12.50|from env>");
  EXPECT_EQ(value(ini, "s", "z"), "5$");
}

TEST(Ini, ReportsUnknownVariables) {
  ::unsetenv("LAMP_INI_TEST");
  EXPECT_THAT(faultsOf("[s]\nx = ${R}\ny = $env{LAMP_INI_TEST}\n@define R 1\n@define\n"),
              ElementsAre("t.ini:2: '${R}' has no '@define R' above it",
                          "t.ini:3: the environment variable 'LAMP_INI_TEST' is not set",
                          HasSubstr("t.ini:5: ")));
}

TEST(Ini, AReplacementLeavesNoSpaceAtTheEnds) {
  EXPECT_EQ(value(read("@define EMPTY\n[s]\nx = ${EMPTY} a ${EMPTY}\n"), "s", "x"), "a");
}

TEST(Ini, RefusesReplacementsThatNoIniCanHold) {
  ::setenv("LAMP_INI_TEST", "one\ntwo", 1);
  for (const char* line : {"x = a ${EMPTY}//b", "x = a\\${EMPTY}", "x = $${EMPTY}{EMPTY}",
                           "x = ${EMPTY}$${EMPTY}env{HOME}", "x = $env{LAMP_INI_TEST}"})
    EXPECT_THAT(faultsOf("@define EMPTY\n[s]\n" + std::string(line) + "\n"),
                ElementsAre(HasSubstr("t.ini:3: the value '")))
        << line;
  EXPECT_THAT(faultsOf("@define EMPTY\n[s]\nx = http://a/b ${EMPTY}\ny = ${open\nz = a\\b $ c\n"),
              IsEmpty());
}

TEST(Ini, ReportsDuplicatesWithBothPlaces) {
  EXPECT_THAT(faultsOf("[s]\nx = 1\nx = 2\n[t]\n[s]\nx = 3\n"),
              ElementsAre("t.ini:3: key 'x' appears twice, first at t.ini:2",
                          "t.ini:5: section [s] appears twice, first at t.ini:1",
                          "t.ini:6: key 'x' appears twice, first at t.ini:2"));
}

TEST(Ini, ReportsAllFaultsOfFormAtOnce) {
  EXPECT_THAT(faultsOf("early = 1\n[s\n[]\n[s]\nno equal sign\n= 3\n[s] ; x\n"),
              ElementsAre(HasSubstr("t.ini:1: 'early = 1' comes before the first [section]"),
                          HasSubstr("t.ini:2: '[s' is not a [section]"),
                          HasSubstr("t.ini:3: '[]' is not a [section]"),
                          HasSubstr("t.ini:5: 'no equal sign' is not 'key = value'"),
                          HasSubstr("t.ini:6: '= 3' is not 'key = value'"),
                          HasSubstr("t.ini:7: '[s] ; x' is not a [section]")));
}

TEST(Ini, EmptyTextHasNoSections) {
  EXPECT_TRUE(read("").sections().empty());
  EXPECT_TRUE(read("\n\n// only a comment").sections().empty());
}

TEST(Ini, ReadsFiles) {
  const std::string path = test::freshFolder() + "/t.ini";
  writeTextFile(path, "[s]\nx = 1\n");
  Faults faults;
  EXPECT_EQ(Ini::fromFile(path, faults).find("s")->find("x")->where, path + ":2");
  EXPECT_THAT(test::thrownBy([&] { Ini::fromFile(path + "x", faults); }), HasSubstr(path + "x"));
}

TEST(Ini, ARecordingGivenByMistakeIsNamedAsSuch) {
  const std::string path = test::freshFolder() + "/robot.rawlog";
  writeTextFile(path, std::string("\x1f\x8b\x08\0\0\x03binary", 12));
  Faults faults;
  EXPECT_THAT(test::thrownBy([&] { Ini::fromFile(path, faults); }),
              HasSubstr("'" + path + "' is not an ini file: it is binary, as rawlogs are"));
}

TEST(IniSet, SplitsAtTheFirstEqualSignThenAtTheLastDotBeforeIt) {
  Ini ini = read("[robot.husky1]\nrawlog = old\nkey = h\n");
  Faults faults;
  ini.set("robot.husky1.rawlog=dir.d/a=b.rawlog", faults);
  ini.set("lamp::Gicp@fine.voxel_m = 0.1", faults);
  EXPECT_THAT(faults.list(), IsEmpty());
  EXPECT_EQ(value(ini, "robot.husky1", "rawlog"), "dir.d/a=b.rawlog");
  EXPECT_EQ(value(ini, "robot.husky1", "key"), "h");
  EXPECT_EQ(value(ini, "lamp::Gicp@fine", "voxel_m"), "0.1");
  EXPECT_THAT(ini.find("robot.husky1")->find("rawlog")->where, HasSubstr("--set"));
}

TEST(IniSet, ReportsWhatIsNoAssignment) {
  Ini ini;
  Faults faults;
  for (const char* text : {"", "a.b", "key=1", ".key=1", "section.=1", "=1", "key=a.b"})
    ini.set(text, faults);
  EXPECT_EQ(faults.list().size(), 7u);
  EXPECT_THAT(faults.list()[1], HasSubstr("'a.b' is not of the form section.key=value"));
  EXPECT_TRUE(ini.sections().empty());
}

TEST(IniSet, RefusesValuesThatNoIniCanHold) {
  Ini ini;
  Faults faults;
  for (const char* text : {"s.a=x // y", "s.b=x\\", "s.c=${HOME}", "s.d=x\ny"})
    ini.set(text, faults);
  ASSERT_EQ(faults.list().size(), 4u);
  EXPECT_THAT(faults.list()[0], HasSubstr("the value 'x // y' cannot stand in an ini"));
}

TEST(IniOptions, FillsAllKinds) {
  const EngineOptions o = readEngine(
      "radius_m = 1e-3\ncount = 12\nenabled = no\nmode = exact\nfile = a b.txt\n"
      "start_pose = [1 -2.5 3]\nweights = 0, 1\nstages = A ,B@x,  C\n");
  EXPECT_EQ(o.radius_m, 1e-3);
  EXPECT_EQ(o.count, 12);
  EXPECT_FALSE(o.enabled);
  EXPECT_EQ(o.mode, "exact");
  EXPECT_EQ(o.file, "a b.txt");
  EXPECT_THAT(o.start_pose, ElementsAre(1, -2.5, 3));
  EXPECT_THAT(o.weights, ElementsAre(0, 1));
  EXPECT_THAT(o.stages, ElementsAre("A", "B@x", "C"));
}

TEST(IniOptions, MissingKeysAndSectionsKeepTheDefaults) {
  const EngineOptions o = readEngine("count = 1\n");
  EXPECT_EQ(o.radius_m, 2.5);
  EXPECT_THAT(o.stages, ElementsAre("One", "Two@b"));
  Faults faults;
  EngineOptions untouched;
  readOptions(nullptr, untouched, faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(untouched.count, 7);
}

TEST(IniOptions, EmptyListIsNotSet) {
  const EngineOptions o = readEngine("start_pose =\nweights = []\nstages =\n");
  EXPECT_TRUE(o.start_pose.empty());
  EXPECT_TRUE(o.weights.empty());
  EXPECT_TRUE(o.stages.empty());
}

TEST(IniOptions, RefusesMalformedNumbers) {
  EXPECT_EQ(optionFault("radius_m = 1 ; x"), "t.ini:2: [engine] radius_m = 1 ; x: is not a number");
  for (const char* text : {"abc", "", "1 # x", "1,5", "nan", "0x10", "1 2"})
    EXPECT_THAT(optionFault("radius_m = " + std::string(text)), HasSubstr("is not a number"))
        << text;
  for (const char* text : {"abc", "", "1.5", "3000000000", "nan", "inf"})
    EXPECT_THAT(optionFault("count = " + std::string(text)), HasSubstr("is not a whole number"))
        << text;
  EXPECT_THAT(optionFault("weights = 0 x 1"), HasSubstr("'x' is not a number"));
  EXPECT_THAT(optionFault("weights = 0 nan"), HasSubstr("'nan' is not a number"));
}

TEST(IniOptions, RefusesWrongWords) {
  EXPECT_THAT(optionFault("enabled = ture"), HasSubstr("must be true or false"));
  EXPECT_THAT(optionFault("enabled ="), HasSubstr("must be true or false"));
  EXPECT_THAT(optionFault("mode = slow"), HasSubstr("must be one of: fast, exact"));
}

TEST(IniOptions, RefusesValuesOutOfRange) {
  EXPECT_THAT(optionFault("radius_m = 0"), HasSubstr("must be above 0"));
  EXPECT_THAT(optionFault("radius_m = -1"), HasSubstr("must be above 0"));
  EXPECT_THAT(optionFault("count = -1"), HasSubstr("must be at least 0"));
  EXPECT_THAT(optionFault("weights = 0.5 1.5"), HasSubstr("must be at least 0 and at most 1"));
}

TEST(IniOptions, RefusesListsOfWrongSize) {
  EXPECT_THAT(optionFault("start_pose = [1 2]"), HasSubstr("needs 3 numbers, has 2"));
  EXPECT_THAT(optionFault("start_pose = [1 2 3 4]"), HasSubstr("needs 3 numbers, has 4"));
}

TEST(IniOptions, AFaultyValueLeavesTheDefault) {
  Faults faults;
  const Ini ini = Ini::fromText("[engine]\nradius_m = -1\nweights = 0 7\n", "t.ini", faults);
  EngineOptions options;
  readOptions(ini.find("engine"), options, faults);
  EXPECT_EQ(faults.list().size(), 2u);
  EXPECT_EQ(options.radius_m, 2.5);
  EXPECT_THAT(options.weights, ElementsAre(0.25, 0.75));
}

TEST(IniOptions, MisspeltKeyNamesTheNearest) {
  EXPECT_THAT(optionFault("raduis_m = 1"),
              testing::AllOf(HasSubstr("t.ini:2: [engine] has no key 'raduis_m'"),
                             HasSubstr("did you mean 'radius_m'?")));
  EXPECT_THAT(optionFault("xyzzy = 1"),
              testing::AllOf(HasSubstr("'xyzzy'"), testing::Not(HasSubstr("did you mean"))));
}

TEST(IniOptions, AllFaultsOfAFileAreThrownAtOnce) {
  Faults faults;
  const Ini ini = Ini::fromText("x = 1\n[engine]\ncount = many\nenabled = ture\nmodus = exact\n",
                                "t.ini", faults);
  EngineOptions options;
  readOptions(ini.find("engine"), options, faults);
  try {
    faults.throwIfAny();
    FAIL() << "nothing was thrown";
  } catch (const ConfigError& error) {
    EXPECT_THAT(splitWords(error.what(), '\n'),
                UnorderedElementsAre(HasSubstr("t.ini:1: "), HasSubstr("t.ini:3: "),
                                     HasSubstr("t.ini:4: "), HasSubstr("t.ini:5: ")));
  }
  EXPECT_NO_THROW(Faults().throwIfAny());
}

TEST(IniOptions, WrittenOptionsReadBackToTheSameValues) {
  EngineOptions options;
  options.radius_m = 1.0 / 3.0;
  options.count = 0;
  options.enabled = false;
  options.mode = "exact";
  options.file = "/data/a b//c#d;e.rawlog";
  options.start_pose = {1e-17, -2.0 / 3.0, 1e20};
  options.weights = {};
  options.stages = {"Three"};
  const std::string text = writeOptions("engine", options);
  EXPECT_THAT(text, HasSubstr("// search radius [m]\nradius_m = "));
  EXPECT_THAT(text, HasSubstr("// how it runs: fast | exact\nmode = exact\n"));

  const Ini ini = read(text);
  Faults faults;
  EngineOptions back;
  readOptions(ini.find("engine"), back, faults);
  EXPECT_THAT(faults.list(), IsEmpty());
  EXPECT_EQ(back.radius_m, options.radius_m);
  EXPECT_EQ(back.count, options.count);
  EXPECT_EQ(back.enabled, options.enabled);
  EXPECT_EQ(back.mode, options.mode);
  EXPECT_EQ(back.file, options.file);
  EXPECT_EQ(back.start_pose, options.start_pose);
  EXPECT_EQ(back.weights, options.weights);
  EXPECT_EQ(back.stages, options.stages);
  EXPECT_EQ(writeOptions("engine", back), text);
}

TEST(IniOptions, MarkdownHasOneRowAKey) {
  MarkdownOptionWriter writer("engine");
  EngineOptions().visit(writer);
  EXPECT_THAT(writer.text(), HasSubstr("### [engine]\n"));
  EXPECT_THAT(writer.text(), HasSubstr("| `radius_m` | `2.5` | m | search radius |\n"));
  EXPECT_THAT(writer.text(), HasSubstr("| `mode` | `fast` |  | how it runs: fast, exact |\n"));
  EXPECT_THAT(writer.text(), HasSubstr("| `start_pose` |  | m | where it starts |\n"));
}

TEST(SplitWords, DropsSpaceAndEmptyWords) {
  EXPECT_THAT(splitWords(" a, ,b c ,"), ElementsAre("a", "b c"));
  EXPECT_THAT(splitWords(""), IsEmpty());
}

}  // namespace
}  // namespace lamp
