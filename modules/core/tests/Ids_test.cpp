#include "lamp/core/Ids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <unordered_set>

#include "TestSupport.h"

namespace lamp {
namespace {

using test::thrownBy;
using testing::HasSubstr;

RobotTable twoRobots() {
  RobotTable robots;
  robots.add("husky1");
  robots.add("spot-2");
  return robots;
}

TEST(RobotTable, KeepsTheOrderInWhichRobotsCame) {
  const RobotTable robots = twoRobots();
  ASSERT_EQ(robots.size(), 2u);
  EXPECT_EQ(robots.name(RobotId{0}), "husky1");
  EXPECT_EQ(robots.name(RobotId{1}), "spot-2");
  EXPECT_EQ(robots.find("spot-2"), RobotId{1});
  EXPECT_FALSE(robots.find("spot"));
  EXPECT_EQ(robots.ids(), (std::vector<RobotId>{{0}, {1}}));
}

TEST(RobotTable, LettersSkipUAndTakenOnes) {
  RobotTable robots;
  robots.add("chosen", 'c');
  std::string letters;
  for (int i = 0; i < 24; ++i) letters += robots.letter(robots.add("r" + std::to_string(i)));
  EXPECT_EQ(letters, "abdefghijklmnopqrstvwxyz");
  EXPECT_EQ(robots.letter(robots.add("next")), 'A');
  EXPECT_EQ(robots.letter(robots.add("anchors", 'u')), 'u');
}

TEST(RobotTable, ManyRobotsHaveSymbolsOfTheirOwn) {
  constexpr int kMany = 189;
  RobotTable robots;
  std::set<uint64_t> symbols;
  for (int i = 0; i < kMany; ++i) {
    const KeyNodeId id{robots.add("r" + std::to_string(i)), 7};
    symbols.insert(robots.symbol(id));
    EXPECT_EQ(robots.fromSymbol(robots.symbol(id)), id);
  }
  EXPECT_EQ(symbols.size(), static_cast<size_t>(kMany));
  EXPECT_EQ(robots.symbol({RobotId{25}, 7}) >> 56, uint64_t{'A'});
  EXPECT_EQ(robots.symbol({RobotId{188}, 7}), 0xFF00000000000007ULL);
  EXPECT_THAT(thrownBy([&] { robots.add("one_too_many"); }), HasSubstr("189 robots"));
}

TEST(RobotTable, RefusesNamesAndLettersThatClashOrAreMalformed) {
  RobotTable robots = twoRobots();
  EXPECT_THAT(thrownBy([&] { robots.add("husky1"); }), HasSubstr("'husky1'"));
  EXPECT_THAT(thrownBy([&] { robots.add("other", 'a'); }), HasSubstr("'a' is taken"));
  EXPECT_THAT(thrownBy([&] { robots.add("other", '-'); }), HasSubstr("letter or digit"));
  EXPECT_THAT(thrownBy([&] { robots.add("a/b"); }), HasSubstr("'a/b'"));
  EXPECT_THAT(thrownBy([&] { robots.add("a:b"); }), HasSubstr("'a:b'"));
  EXPECT_THAT(thrownBy([&] { robots.add(""); }), HasSubstr("letters"));
  EXPECT_EQ(robots.size(), 2u);
}

TEST(RobotTable, TextFormReadsBack) {
  const RobotTable robots = twoRobots();
  for (const uint32_t index : {0u, 7u, 1000000000u, std::numeric_limits<uint32_t>::max()}) {
    const KeyNodeId id{RobotId{1}, index};
    EXPECT_EQ(robots.format(id), "spot-2:" + std::to_string(index));
    EXPECT_EQ(robots.parse(robots.format(id)), id);
  }
}

TEST(RobotTable, ParseNamesWhatItRefuses) {
  const RobotTable robots = twoRobots();
  for (const char* text : {"husky1", "husky1:", ":3", "husky1:-3", "husky1:+3", "husky1: 3",
                           "husky1:3x", "husky1:4294967296", "nobody:3", ""})
    EXPECT_THAT(thrownBy([&] { robots.parse(text); }), HasSubstr("'" + std::string(text) + "'"));
}

TEST(RobotTable, SymbolsAreThoseOfGtsam) {
  const RobotTable robots = twoRobots();
  const KeyNodeId id{RobotId{1}, 42};
  EXPECT_EQ(robots.symbol(id), 0x620000000000002AULL);  // gtsam::Symbol('b', 42)
  EXPECT_EQ(robots.fromSymbol(0x620000000000002AULL), id);
  const KeyNodeId last{RobotId{0}, std::numeric_limits<uint32_t>::max()};
  EXPECT_EQ(robots.fromSymbol(robots.symbol(last)), last);
}

TEST(RobotTable, RefusesSymbolsOfNobodyAndIndicesAbove32Bits) {
  const RobotTable robots = twoRobots();
  EXPECT_THAT(thrownBy([&] { robots.fromSymbol(0x7A00000000000001ULL); }), HasSubstr("no known"));
  EXPECT_THAT(thrownBy([&] { robots.fromSymbol(0x6100000100000000ULL); }), HasSubstr("32 bits"));
}

TEST(KeyNodeId, OrdersByRobotThenIndex) {
  const KeyNodeId a0{RobotId{0}, 0}, a9{RobotId{0}, 9}, b1{RobotId{1}, 1};
  EXPECT_LT(a0, a9);
  EXPECT_LT(a9, b1);
  EXPECT_NE(a0, a9);
  EXPECT_EQ(std::unordered_set<KeyNodeId>({a0, a9, b1, a9}).size(), 3u);
}

TEST(RobotName, IsMadeOfAFileStem) {
  EXPECT_EQ(robotNameFromStem("2006-01 SENA (loop)"), "2006-01_SENA__loop_");
  EXPECT_EQ(robotNameFromStem("B0"), "B0");
  EXPECT_EQ(robotNameFromStem(""), "robot");
}

}  // namespace
}  // namespace lamp
