#include "lamp/core/Stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestSupport.h"

namespace lamp {

class Counter : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(Counter)
 public:
  virtual int count() const = 0;
};

class UpCounter : public Counter {
  DEFINE_MRPT_OBJECT(UpCounter, lamp)
 public:
  void visit(OptionVisitor& v) override { v("start", start_, "", "first number", kNotNegative); }
  int count() const override { return start_; }

 private:
  int start_ = 1;
};

class DownCounter : public Counter {
  DEFINE_MRPT_OBJECT(DownCounter, lamp)
 public:
  void visit(OptionVisitor&) override {}
  int count() const override { return -1; }
};

/** A stage of another kind. */
class Bystander : public Stage {
  DEFINE_MRPT_OBJECT(Bystander, lamp)
 public:
  void visit(OptionVisitor&) override {}
};

}  // namespace lamp

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Counter, lamp::Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(UpCounter, lamp::Counter, lamp)
IMPLEMENTS_MRPT_OBJECT(DownCounter, lamp::Counter, lamp)
IMPLEMENTS_MRPT_OBJECT(Bystander, lamp::Stage, lamp)

namespace lamp {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class StageFactory : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    registerAllClasses_lamp_core();
    mrpt::rtti::registerClass(CLASS_ID(Counter));
    mrpt::rtti::registerClass(CLASS_ID(UpCounter));
    mrpt::rtti::registerClass(CLASS_ID(DownCounter));
    mrpt::rtti::registerClass(CLASS_ID(Bystander));
  }

  std::shared_ptr<Counter> make(const std::string& name, const std::string& ini_text = "") {
    const Ini ini = Ini::fromText(ini_text, "t.ini", faults_);
    return makeStage<Counter>(StageName::parse(name), "counter", "t.ini:9", ini, faults_);
  }

  Faults faults_;
};

TEST(StageName, IsAClassOrAnInstanceOfOne) {
  const StageName plain = StageName::parse("Gicp"), named = StageName::parse("Gicp@coarse");
  EXPECT_EQ(plain.class_name, "Gicp");
  EXPECT_EQ(plain.instance, "");
  EXPECT_EQ(plain.section(), "lamp::Gicp");
  EXPECT_EQ(named.class_name, "Gicp");
  EXPECT_EQ(named.instance, "coarse");
  EXPECT_EQ(named.text(), "Gicp@coarse");
  EXPECT_EQ(named.section(), "lamp::Gicp@coarse");
}

TEST_F(StageFactory, ListsTheClassesOfOneKind) {
  EXPECT_THAT(stageClasses(CLASS_ID(Counter)), ElementsAre("DownCounter", "UpCounter"));
  EXPECT_THAT(stageClasses(CLASS_ID(Stage)),
              AllOf(Contains("Bystander"), Contains("UpCounter"), Not(Contains("Counter"))));
}

TEST_F(StageFactory, MakesAStageWithDefaults) {
  const auto counter = make("UpCounter");
  ASSERT_TRUE(counter);
  EXPECT_THAT(faults_.list(), IsEmpty());
  EXPECT_EQ(counter->count(), 1);
}

TEST_F(StageFactory, InstancesHaveTheirOwnSections) {
  const std::string ini = "[lamp::UpCounter]\nstart = 2\n[lamp::UpCounter@late]\nstart = 30\n";
  EXPECT_EQ(make("UpCounter", ini)->count(), 2);
  const auto late = make("UpCounter@late", ini);
  EXPECT_EQ(late->count(), 30);
  EXPECT_EQ(late->getLoggerName(), "UpCounter@late");
  EXPECT_EQ(make("UpCounter@other", ini)->count(), 1);
  EXPECT_THAT(faults_.list(), IsEmpty());
}

TEST_F(StageFactory, UnknownNameListsTheKnownOnes) {
  EXPECT_FALSE(make("UpCuonter"));
  EXPECT_THAT(faults_.list(),
              ElementsAre("t.ini:9: there is no counter 'UpCuonter' (did you mean 'UpCounter'?); "
                          "known: DownCounter, UpCounter"));
}

TEST_F(StageFactory, StagesOfAnotherKindAndAbstractOnesAreUnknown) {
  EXPECT_FALSE(make("Bystander"));
  EXPECT_FALSE(make("Counter"));
  EXPECT_FALSE(make(""));
  EXPECT_EQ(faults_.list().size(), 3u);
}

TEST_F(StageFactory, FaultsInTheSectionAreCollected) {
  EXPECT_TRUE(make("UpCounter", "[lamp::UpCounter]\nstart = -1\nstrat = 1\n"));
  EXPECT_THAT(faults_.list(), ElementsAre(HasSubstr("t.ini:2: "), HasSubstr("t.ini:3: ")));
}

TEST_F(StageFactory, PluginBringsInAStage) {
  ASSERT_THAT(stageClasses(CLASS_ID(Stage)), Not(Contains("PluginStage")));
  loadPlugins({LAMP_TEST_PLUGIN});
  ASSERT_THAT(stageClasses(CLASS_ID(Stage)), Contains("PluginStage"));

  const Ini ini = Ini::fromText("[lamp::PluginStage]\ngain = 4.5\n", "t.ini", faults_);
  const auto stage =
      makeStage<Stage>(StageName::parse("PluginStage"), "stage", "t.ini:9", ini, faults_);
  ASSERT_TRUE(stage);
  EXPECT_THAT(faults_.list(), IsEmpty());
  EXPECT_THAT(writeOptions("s", *stage), HasSubstr("gain = 4.5\n"));
}

TEST_F(StageFactory, PluginThatIsNotThereIsNamed) {
  EXPECT_THAT(test::thrownBy([] { loadPlugins({"libnowhere.so"}); }),
              AllOf(HasSubstr("cannot load 'libnowhere.so'"), HasSubstr("No such file")));
}

TEST_F(StageFactory, PluginThatIsNoLibraryIsNamed) {
  const std::string source = LAMP_SOURCE_DIR "/LICENSE";
  EXPECT_THAT(test::thrownBy([&] { loadPlugins({source}); }), HasSubstr("'" + source + "'"));
}

}  // namespace
}  // namespace lamp
