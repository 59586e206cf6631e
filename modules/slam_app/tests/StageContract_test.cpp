// What every stage of every kind must hold to: how it is named and configured. What the kinds must
// do is in the suites of the same name in their modules.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include "StageSuite.h"
#include "lamp/slam_app/StageKinds.h"

namespace lamp {
namespace {

std::vector<std::string> allStages() {
  registerAllClasses_lamp();
  std::vector<std::string> all;
  for (const StageKind& kind : stageKinds())
    for (const std::string& name : stageClasses(kind.base)) all.push_back(name);
  return all;
}

/** Gives every option another allowed value, and keeps what is said of it. */
class Changer : public OptionVisitor {
 public:
  std::vector<OptionInfo> infos;

 protected:
  static double other(const OptionInfo& info, double value, double step) {
    return value + step <= info.range.max ? value + step : value - step;
  }
  void onOption(const OptionInfo& info, double& value) override {
    infos.push_back(info);
    const double width = info.range.max - info.range.min;
    value = other(info, value, std::isfinite(width) ? width / 16 : 0.3);
  }
  void onOption(const OptionInfo& info, int& value) override {
    infos.push_back(info);
    value = static_cast<int>(other(info, value, 1));
  }
  void onOption(const OptionInfo& info, bool& value) override {
    infos.push_back(info);
    value = !value;
  }
  void onOption(const OptionInfo& info, std::string& value) override {
    infos.push_back(info);
    value = info.choices.empty()            ? "other"
            : value == info.choices.front() ? info.choices.back()
                                            : info.choices.front();
  }
  void onOption(const OptionInfo& info, std::vector<double>& value, size_t size) override {
    infos.push_back(info);
    value.assign(size == 0 ? 2 : size, std::isfinite(info.range.min) ? info.range.min : 1.0);
  }
  void onOption(const OptionInfo& info, std::vector<std::string>& value) override {
    infos.push_back(info);
    value = {"one", "two"};
  }
};

class AnyStage : public testing::TestWithParam<std::string> {
 protected:
  /** The stage as an ini with this text makes it, which must have no fault. */
  std::shared_ptr<Stage> make(const std::string& text = "") const {
    Faults faults;
    const Ini ini = Ini::fromText(text, "test.ini", faults);
    auto stage = makeStage<Stage>(StageName::parse(GetParam()), "stage", "", ini, faults);
    EXPECT_TRUE(faults.empty()) << faults.list().front();
    return stage;
  }
  static std::string optionsOf(Stage& stage) {
    return writeOptions("lamp::" + stage.getLoggerName(), stage);
  }
};
INSTANTIATE_TEST_SUITE_P(All, AnyStage, testing::ValuesIn(allStages()), test::testName);

TEST_P(AnyStage, IsOfOneKindAndKnowsItsName) {
  size_t kinds = 0;
  for (const StageKind& kind : stageKinds()) {
    const std::vector<std::string> names = stageClasses(kind.base);
    kinds += std::count(names.begin(), names.end(), GetParam());
  }
  EXPECT_EQ(kinds, 1u);
  EXPECT_EQ(make()->getLoggerName(), GetParam());
}

TEST_P(AnyStage, WritesOptionsThatReadBackTheSame) {
  const auto stage = make();
  EXPECT_EQ(optionsOf(*make(optionsOf(*stage))), optionsOf(*stage)) << "the defaults";
  Changer changer;
  stage->visit(changer);
  const std::string changed = optionsOf(*stage);
  EXPECT_EQ(changed == optionsOf(*make()), changer.infos.empty()) << "the changes have stayed";
  EXPECT_EQ(optionsOf(*make(changed)), changed);
}

TEST_P(AnyStage, SharesNoOptionWithAnotherOfItsClass) {
  const auto stage = make(), other = make();
  const std::string before = optionsOf(*other);
  Changer changer;
  stage->visit(changer);
  EXPECT_EQ(optionsOf(*other), before);
  EXPECT_EQ(optionsOf(*make()), before);
}

TEST_P(AnyStage, DescribesEachOptionOnceWithItsUnit) {
  Changer changer;
  make()->visit(changer);
  std::set<std::string> keys;
  for (const OptionInfo& info : changer.infos) {
    EXPECT_TRUE(keys.insert(info.key).second) << info.key << " appears twice";
    EXPECT_FALSE(info.meaning.empty()) << info.key;
    for (const char c : info.key)
      EXPECT_TRUE(std::islower(c) || std::isdigit(c) || c == '_') << info.key;
    for (const std::string unit : {"m", "s", "deg", "rad"})
      if (info.unit == unit) {
        const size_t end = info.key.rfind("_" + unit);
        EXPECT_TRUE(end != std::string::npos && end + unit.size() + 1 == info.key.size())
            << info.key << " is in " << unit;
      }
  }
}

}  // namespace
}  // namespace lamp
