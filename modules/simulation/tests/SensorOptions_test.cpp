#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lamp/simulation/Artifacts.h"
#include "lamp/simulation/Imu.h"
#include "lamp/simulation/Lidar.h"
#include "lamp/simulation/Link.h"
#include "lamp/simulation/OdometryModel.h"
#include "lamp/simulation/Radio.h"

namespace lamp::simulation {
namespace {

/** Checks that each key comes once, with a meaning, and that its default is allowed. */
class DefaultsChecker : public OptionVisitor {
 public:
  size_t count() const { return keys_.size(); }

 protected:
  void onOption(const OptionInfo& info, double& value) override { check(info, value); }
  void onOption(const OptionInfo& info, int& value) override { check(info, value); }
  void onOption(const OptionInfo& info, bool&) override { checkName(info); }
  void onOption(const OptionInfo& info, std::string& value) override {
    checkName(info);
    const auto& words = info.choices;
    EXPECT_TRUE(words.empty() || std::count(words.begin(), words.end(), value)) << info.key;
  }
  void onOption(const OptionInfo& info, std::vector<double>& value, size_t size) override {
    checkName(info);
    EXPECT_TRUE(value.empty() || size == 0 || value.size() == size) << info.key;
  }
  void onOption(const OptionInfo& info, std::vector<std::string>&) override { checkName(info); }

 private:
  void checkName(const OptionInfo& info) {
    EXPECT_TRUE(keys_.insert(info.key).second) << info.key << " comes twice";
    EXPECT_FALSE(info.meaning.empty()) << info.key;
  }
  void check(const OptionInfo& info, double value) {
    checkName(info);
    EXPECT_GE(value, info.range.min) << info.key;
    EXPECT_LE(value, info.range.max) << info.key;
  }
  std::set<std::string> keys_;
};

template <class Options>
class SensorOptions : public testing::Test {};
using All = testing::Types<LidarOptions, OdometryOptions, ImuOptions, RadioOptions, LinkOptions,
                           ArtifactOptions>;
TYPED_TEST_SUITE(SensorOptions, All);

TYPED_TEST(SensorOptions, DefaultsAreAllowedAndKeysComeOnce) {
  TypeParam options;
  DefaultsChecker checker;
  options.visit(checker);
  EXPECT_GE(checker.count(), 5u);
}

}  // namespace
}  // namespace lamp::simulation
