// What the real program says and does when its input is not as it should be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <chrono>
#include <limits>
#include <optional>

#include "Experiment.h"

namespace lamp::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kFailed = 1;
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;

template <class T>
bool is(const Objects::value_type& object) {
  return dynamic_cast<const T*>(object.get()) != nullptr;
}

template <class T>
Objects without(const Objects& objects) {
  Objects rest;
  std::copy_if(objects.begin(), objects.end(), std::back_inserter(rest),
               [](const auto& object) { return !is<T>(object); });
  return rest;
}

template <class T>
std::shared_ptr<T> copyOf(const Objects::value_type& object) {
  return std::dynamic_pointer_cast<T>(object->duplicateGetSmartPtr());
}

/** A copy of the objects, with copies of the scans that `change` may alter. */
template <class Change>
Objects withScans(const Objects& objects, const Change& change) {
  Objects changed;
  for (const auto& object : objects) {
    changed.push_back(object);
    if (!is<CObservationPointCloud>(object)) continue;
    const auto scan = copyOf<CObservationPointCloud>(object);
    scan->pointcloud = std::make_shared<mrpt::maps::CSimplePointsMap>(
        dynamic_cast<const mrpt::maps::CSimplePointsMap&>(*scan->pointcloud));
    change(*scan);
    changed.back() = scan;
  }
  return changed;
}

/** A short and good recording of the robot A, to be damaged. */
class BadInput : public testing::Test {
 protected:
  BadInput() {
    SyntheticRobot robot;
    robot.name = "A";
    robot.route = shortRoute();
    good_ = robot.record3d(BoxWorld::building(7)).objects;
  }

  LampResult run(const std::vector<std::string>& rawlogs, const std::string& out = "run") const {
    std::vector<std::string> arguments = {experiment_.file("experiment.ini", iniFor3d())};
    arguments.insert(arguments.end(), rawlogs.begin(), rawlogs.end());
    return experiment_.run(arguments, out);
  }
  LampResult run(const Objects& objects, const std::string& out = "run") const {
    return run({experiment_.rawlog("A.rawlog", objects)}, out);
  }

  size_t keyNodes(const std::string& out = "run") const {
    return experiment_.result(out).keyNodes("A").size();
  }

  /** The graph, byte for byte, is that of the good recording. */
  void expectSameAsGood(const std::string& out = "run") const {
    const LampResult end = run(good_, "good");
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.err, IsEmpty());
    const auto graph = readFile(experiment_.result("good").folder().graphG2o());
    EXPECT_EQ(readFile(experiment_.result(out).folder().graphG2o()), graph);
  }

  void expectNothingWritten() const { EXPECT_FALSE(experiment_.result().has("summary.json")); }

  Objects good_;
  Experiment experiment_;
};

TEST_F(BadInput, MissingRawlog) {
  const LampResult end = run({experiment_.path("not-there.rawlog")});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(experiment_.path("not-there.rawlog")));
  EXPECT_FALSE(experiment_.result().has("")) << "a run that cannot start leaves no folder";
}

TEST_F(BadInput, FolderInPlaceOfARawlog) {
  const LampResult end = run({experiment_.path("")});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, HasSubstr(experiment_.path("")));
}

TEST_F(BadInput, TextNamedRawlog) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "1.25 3.5 this is no rawlog at all\n";
  const LampResult end = run({experiment_.file("text.rawlog", text)});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("text.rawlog"), HasSubstr("not an MRPT rawlog")));
  expectNothingWritten();
}

TEST_F(BadInput, EmptyFile) {
  const LampResult end = run({experiment_.file("empty.rawlog", "")});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("empty.rawlog"), HasSubstr("empty")));
}

TEST_F(BadInput, NoRawlogAtAll) {
  const LampResult end = run(std::vector<std::string>{});
  EXPECT_NE(end.exit_code, 0);
  EXPECT_THAT(end.err, HasSubstr("rawlog"));
}

TEST_F(BadInput, RawlogCutInTheMiddle) {
  const std::string bytes = bytesOf(good_);
  const std::string cut = bytes.substr(0, bytes.size() / 2);
  const LampResult end = run({experiment_.file("A.rawlog", cut)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("A.rawlog"), HasSubstr("cut off"), HasSubstr("lost")));
  EXPECT_THAT(experiment_.result().summary()["warnings"].dump(), HasSubstr("cut off"));

  ASSERT_EQ(run(good_, "good").exit_code, 0);
  EXPECT_NEAR(static_cast<double>(keyNodes()), static_cast<double>(keyNodes("good")) / 2, 1);
}

TEST_F(BadInput, GzippedRawlogCutInTheMiddle) {
  writeGzFile(experiment_.path("whole.rawlog"), bytesOf(good_));
  const std::string bytes = readFile(experiment_.path("whole.rawlog"));
  const LampResult end = run({experiment_.file("A.rawlog", bytes.substr(0, bytes.size() / 2))});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("A.rawlog"), HasSubstr("lost")));

  ASSERT_EQ(run({experiment_.path("whole.rawlog")}, "good").exit_code, 0);
  EXPECT_NEAR(static_cast<double>(keyNodes()), static_cast<double>(keyNodes("good")) / 2, 1);
}

TEST_F(BadInput, UnknownClassInTheStream) {
  const auto half = good_.begin() + static_cast<std::ptrdiff_t>(good_.size() / 2);
  const std::string foreign = foreignObject("CObservationOfMine", std::string(500, 'x'));
  const std::string bytes =
      bytesOf(Objects(good_.begin(), half)) + foreign + bytesOf(Objects(half, good_.end()));
  const LampResult end = run({experiment_.file("A.rawlog", bytes)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("A.rawlog"), HasSubstr("1 object of the unknown class"),
                             HasSubstr("CObservationOfMine")));
  expectSameAsGood();
}

TEST_F(BadInput, NoOdometry) {
  const LampResult end = run(without<mrpt::obs::CObservationRobotPose>(good_));
  EXPECT_EQ(end.exit_code, 0) << "the lidar tells the motion, too";
  EXPECT_THAT(end.err, HasSubstr("robot 'A': no odometry"));
}

TEST_F(BadInput, NoOdometryAndNotTheLidarsEither) {
  const LampResult end = experiment_.run(
      {experiment_.file("experiment.ini", iniFor3d()),
       experiment_.rawlog("A.rawlog", without<mrpt::obs::CObservationRobotPose>(good_)), "--set",
       "pipeline.odometry=RecordedOdometry"});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("no key node"), HasSubstr("robot 'A'"),
                             HasSubstr("no odometry covers them")));
  expectNothingWritten();
}

TEST_F(BadInput, NoScans) {
  const LampResult end = run(without<CObservationPointCloud>(good_));
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("robot 'A'"), HasSubstr("no lidar scan")));
  expectNothingWritten();
}

TEST_F(BadInput, AllScansEmpty) {
  const LampResult end =
      run(withScans(good_, [](CObservationPointCloud& scan) { scan.pointcloud->clear(); }));
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("robot 'A'"), HasSubstr("no usable point")));
  expectNothingWritten();
}

TEST_F(BadInput, SomeScansEmpty) {
  size_t count = 0;
  const LampResult end = run(withScans(good_, [&](CObservationPointCloud& scan) {
    if (++count % 3 == 1) scan.pointcloud->clear();  // the first one too
  }));
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("robot 'A'"), HasSubstr("no usable point")));
  EXPECT_EQ(experiment_.result().trajectory("A").size(), count) << "empty scans have a pose too";
}

TEST_F(BadInput, PointsWithoutARange) {
  const LampResult end = run(withScans(good_, [](CObservationPointCloud& scan) {
    for (int i = 0; i < 50; ++i) {
      scan.pointcloud->insertPointFast(0, 0, 0);
      scan.pointcloud->insertPointFast(kNaN, 1, 1);
      scan.pointcloud->insertPointFast(1, 1, std::numeric_limits<float>::infinity());
    }
  }));
  ASSERT_EQ(end.exit_code, 0) << end.err;
  expectSameAsGood();
}

TEST_F(BadInput, OdometryThatIsNoNumber) {
  Objects objects = good_;
  for (size_t i = 3; i < objects.size(); i += 7) {
    if (!is<mrpt::obs::CObservationRobotPose>(objects[i])) continue;
    const auto odometry = copyOf<mrpt::obs::CObservationRobotPose>(objects[i]);
    odometry->pose.mean.x(std::numeric_limits<double>::quiet_NaN());
    objects[i] = odometry;
  }
  const LampResult end = run(objects);
  ASSERT_EQ(end.exit_code, 0) << end.err;
  for (const StampedPose& pose : experiment_.result().trajectory("A"))
    EXPECT_TRUE(pose.pose.matrix().allFinite());
}

TEST_F(BadInput, OdometryThatBeginsAnew) {
  using mrpt::obs::CObservationRobotPose;
  Objects objects = good_;
  std::optional<mrpt::poses::CPose3D> anew;
  for (size_t i = objects.size() / 2; i < objects.size(); ++i) {
    if (!is<CObservationRobotPose>(objects[i])) continue;
    const auto odometry = copyOf<CObservationRobotPose>(objects[i]);
    if (!anew) anew = odometry->pose.mean;
    odometry->pose.mean = odometry->pose.mean - *anew;
    objects[i] = odometry;
  }
  const LampResult end = run(objects), good = run(good_, "good");
  ASSERT_EQ(end.exit_code, 0) << end.err;
  ASSERT_EQ(good.exit_code, 0) << good.err;
  EXPECT_THAT(end.err, HasSubstr("odometry begins anew"));
  EXPECT_EQ(experiment_.result().summary()["robots"][0]["warnings"].size(), 1u);
  const auto found = experiment_.result().trajectory("A");
  const auto expected = experiment_.result("good").trajectory("A");
  ASSERT_EQ(found.size(), expected.size());
  for (size_t i = 0; i < found.size(); ++i)
    EXPECT_LT((found[i].pose.translation() - expected[i].pose.translation()).norm(), 0.5) << i;
}

TEST_F(BadInput, OneStampADayAhead) {
  for (const bool scan : {true, false}) {
    Objects objects = good_;
    size_t at = objects.size() / 3;
    while (is<CObservationPointCloud>(objects[at]) != scan) ++at;
    const auto wrong = copyOf<CObservation>(objects[at]);
    wrong->timestamp += std::chrono::hours(24);
    objects[at] = wrong;
    const std::string out = scan ? "scan" : "odometry";
    const LampResult end = run(objects, out);
    ASSERT_EQ(end.exit_code, 0) << end.err;
    EXPECT_THAT(end.err, AllOf(HasSubstr("1 observation dropped"), HasSubstr("lies ahead")));
    const LampResult good = run(good_, "good_" + out);
    ASSERT_EQ(good.exit_code, 0) << good.err;
    EXPECT_NEAR(static_cast<double>(experiment_.result(out).trajectory("A").size()),
                static_cast<double>(experiment_.result("good_" + out).trajectory("A").size()), 1);
  }
}

TEST_F(BadInput, StampsRepeatAndGoBackwards) {
  Objects objects;
  for (size_t i = 0; i < good_.size(); ++i) {
    objects.push_back(good_[i]);
    if (i % 10 == 0) objects.push_back(good_[i]);
    if (i == 50) objects.push_back(good_[4]);  // 5 s and more ago: too late to be sorted in
    if (i == 50) objects.push_back(good_[0]);
  }
  ASSERT_NE(is<CObservationPointCloud>(good_[4]), is<CObservationPointCloud>(good_[0]));
  const LampResult end = run(objects);
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("repeats the one before"), HasSubstr("goes back in time"),
                             HasSubstr("'lidar'"), HasSubstr("'odom'")));
  expectSameAsGood();
}

TEST_F(BadInput, RobotThatNoRecordingHolds) {
  const std::string ini = iniFor3d("", "[robot.A]\n[robot.ghost]\n");
  const LampResult end =
      experiment_.run({experiment_.file("ghost.ini", ini), experiment_.rawlog("A.rawlog", good_)});
  ASSERT_EQ(end.exit_code, 0) << end.err;
  EXPECT_THAT(end.err, AllOf(HasSubstr("robot 'ghost'"), HasSubstr("no observation")));
}

TEST_F(BadInput, RobotNamesThatClash) {
  const std::string here = experiment_.rawlog("here/log.rawlog", good_);
  const std::string there = experiment_.rawlog("there/log.rawlog", good_);
  const LampResult end = run({here, there});
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("robot 'A' is in two rawlogs"), HasSubstr(here),
                             HasSubstr(there), HasSubstr("[robot.NAME] rawlog")));
  expectNothingWritten();
}

TEST_F(BadInput, OutFolderInUse) {
  experiment_.file("run/precious.txt", "keep me");
  const LampResult end = run(good_);
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr(experiment_.path("run")), HasSubstr("holds files already"),
                             HasSubstr("name a new folder")));
  EXPECT_EQ(experiment_.result().files().size(), 1u);
  EXPECT_EQ(readFile(experiment_.path("run/precious.txt")), "keep me");
}

TEST_F(BadInput, OutIsAFile) {
  experiment_.file("run", "keep me");
  const LampResult end = run(good_);
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr(experiment_.path("run")), HasSubstr("is a file")));
  EXPECT_EQ(readFile(experiment_.path("run")), "keep me");
}

TEST_F(BadInput, OutBelowAFile) {
  experiment_.file("file", "keep me");
  const LampResult end = run(good_, "file/run");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err,
              AllOf(HasSubstr(experiment_.path("file/run")), HasSubstr("cannot be written")));
  EXPECT_EQ(readFile(experiment_.path("file")), "keep me");
}

TEST_F(BadInput, OutFolderThatCannotBeWritten) {
  const LampResult end = run(good_, "../../../../../../../../proc/lamp-run");
  EXPECT_EQ(end.exit_code, kFailed);
  EXPECT_THAT(end.err, AllOf(HasSubstr("proc/lamp-run"), HasSubstr("cannot be written")));
}

}  // namespace
}  // namespace lamp::test
