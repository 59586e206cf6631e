#include "lamp/input/RawlogSource.h"

#include <gmock/gmock.h>
#include <mrpt/obs/CObservation3DRangeScan.h>

#include <algorithm>

#include "RecordingTools.h"
#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {
namespace {

using namespace test;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class RawlogSourceTest : public testing::Test {
 protected:
  std::string write(const std::string& name, const Objects& objects) {
    const std::string path = folder_ + "/" + name;
    writeGzFile(path, bytesOf(objects));
    return path;
  }

  /** Reads to the end; `robot:label@stamp` of each observation. */
  std::vector<std::string> drain(RawlogSource& source) {
    std::vector<std::string> all;
    while (const auto o = source.next()) {
      all.push_back(table_.name(o->robot) + ":" + o->label + "@" +
                    std::to_string(static_cast<int>(o->stamp * 10)));
    }
    return all;
  }

  std::string errorOf(const std::vector<std::string>& rawlogs,
                      const std::vector<RobotOptions>& robots = {}) {
    try {
      RawlogSource source(rawlogs, robots, table_);
      drain(source);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  static RobotOptions robot(const std::string& name, const std::string& rawlog = "") {
    RobotOptions options;
    options.name = name;
    options.rawlog = rawlog;
    return options;
  }

  const std::string folder_ = freshFolder();
  RobotTable table_;
};

TEST_F(RawlogSourceTest, LabelsNameRobots) {
  const auto path = write("team.rawlog", {wheels(1, "r1/odo"), cloud(2, "r1/lidar/top"),
                                          wheels(3, "r2/odo"), cloud(4, "r2/lidar/top")});
  RawlogSource source({path}, {}, table_);
  EXPECT_THAT(drain(source),
              ElementsAre("r1:odo@10", "r1:lidar/top@20", "r2:odo@30", "r2:lidar/top@40"));
  EXPECT_EQ(source.progress(), 1.0);
  EXPECT_FALSE(source.next());
}

TEST_F(RawlogSourceTest, SaysThatASensorHasAnotherClock) {
  for (const double offset : {-300.0, -5.0, 0.0, 0.6, 5.0}) {
    Objects objects;
    for (int i = 0; i < 40; ++i) {
      objects.push_back(cloud(1000 + 2 * i, "lidar"));
      objects.push_back(wheels(1000 + 2 * i + 1 + offset, "odo"));
      objects.push_back(wheels(1000 + 2 * i + 1.5 + offset, "odo"));
    }
    RawlogSource source({write("clock.rawlog", objects)}, {}, table_);
    drain(source);
    if (std::abs(offset) < 1)
      EXPECT_THAT(source.warnings(), IsEmpty()) << offset;
    else
      EXPECT_THAT(source.warnings(),
                  Contains(AllOf(HasSubstr("'odo'"), HasSubstr("is its clock another one"),
                                 HasSubstr(offset > 0 ? "4.0 s after" : " s before"))))
          << offset;
  }
}

TEST_F(RawlogSourceTest, IniThenStemNameTheRest) {
  const auto a = write("a.rawlog", {wheels(1, "odo")});
  const auto b = write("run b.rawlog", {wheels(2, "/odo")});
  RawlogSource source({b}, {robot("husky", a)}, table_);
  EXPECT_THAT(drain(source), ElementsAre("husky:odo@10", "run_b:/odo@20"));
}

TEST_F(RawlogSourceTest, RobotsOfTheIniComeFirstWithTheirLetters) {
  auto husky = robot("husky");
  husky.key = "h";
  const auto path =
      write("x.rawlog", {wheels(1, "other/odo"), cloud(1, "other/lidar"), wheels(2, "husky/odo")});
  RawlogSource source({path}, {husky, robot("absent")}, table_);
  drain(source);
  ASSERT_EQ(table_.size(), 3u);
  EXPECT_EQ(table_.name(RobotId{0}), "husky");
  EXPECT_EQ(table_.letter(RobotId{0}), 'h');
  EXPECT_EQ(table_.name(RobotId{1}), "absent");
  EXPECT_EQ(table_.name(RobotId{2}), "other");
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("robot 'absent': no observation")));
}

TEST_F(RawlogSourceTest, ClashesAreErrors) {
  const auto a = write("a.rawlog", {wheels(1, "husky/odo"), cloud(1, "husky/lidar")});
  const auto b = write("b.rawlog", {wheels(2, "husky/odo"), cloud(2, "husky/lidar")});
  const std::string error = errorOf({a, b});
  EXPECT_THAT(error, AllOf(HasSubstr("robot 'husky'"), HasSubstr(a), HasSubstr(b)));
}

TEST_F(RawlogSourceTest, WrongAndRepeatedKeysAreErrors) {
  const auto a = write("a.rawlog", {wheels(1, "odo")});
  auto one = robot("one"), two = robot("two");
  one.key = "xy";
  EXPECT_THAT(errorOf({a}, {one}), HasSubstr("[robot.one] key = xy"));
  table_ = {};
  one.key = two.key = "x";
  EXPECT_NE(errorOf({a}, {one, two}), "no error");
}

TEST_F(RawlogSourceTest, OneFileOfTwoRobotsNeedsLabels) {
  const auto good = write("good.rawlog", {wheels(1, "one/odo"), wheels(2, "two/odo")});
  EXPECT_EQ(errorOf({good}, {robot("one", good), robot("two", good)}), "no error");
  table_ = {};
  const auto bad = write("bad.rawlog", {wheels(1, "odo")});
  EXPECT_THAT(errorOf({}, {robot("one", bad), robot("two", bad)}), HasSubstr("label 'odo'"));
}

TEST_F(RawlogSourceTest, SlashesInSensorNamesAreNoRobots) {
  const auto path =
      write("a.rawlog", {wheels(1, "odom"), cloud(2, "velodyne/points"), cloud(3, "imu/data")});
  {
    RawlogSource source({path}, {}, table_);
    EXPECT_THAT(drain(source), ElementsAre("a:odom@10", "a:velodyne/points@20", "a:imu/data@30"));
  }
  table_ = {};
  RawlogSource source({}, {robot("husky", path)}, table_);
  EXPECT_THAT(drain(source),
              ElementsAre("husky:odom@10", "husky:velodyne/points@20", "husky:imu/data@30"));
}

TEST_F(RawlogSourceTest, SensorsOutsideTheOneRobotsLabelsAreItsOwn) {
  const auto path =
      write("a.rawlog", {wheels(1, "husky/odom"), cloud(2, "husky/top"), cloud(3, "rear/points")});
  RawlogSource source({path}, {}, table_);
  EXPECT_THAT(drain(source), ElementsAre("husky:odom@10", "husky:top@20", "husky:rear/points@30"));
}

TEST_F(RawlogSourceTest, TheInisNameWinsOverTheLabels) {
  const auto a = write("a.rawlog", {wheels(1, "husky/odom"), cloud(2, "husky/top")});
  const auto b = write("b.rawlog", {wheels(3, "husky/odom"), cloud(4, "husky/top")});
  RawlogSource source({}, {robot("monday", a), robot("tuesday", b)}, table_);
  EXPECT_THAT(drain(source),
              ElementsAre("monday:odom@10", "monday:top@20", "tuesday:odom@30", "tuesday:top@40"));
  EXPECT_THAT(source.warnings(), IsEmpty());
  EXPECT_EQ(table_.size(), 2u);
}

TEST_F(RawlogSourceTest, ARecordingOfSeveralRobotsIsNotGivenToOne) {
  const auto path = write("team.rawlog", {wheels(1, "r1/odo"), cloud(2, "r1/lidar"),
                                          wheels(3, "r2/odo"), cloud(4, "r2/lidar")});
  EXPECT_THAT(errorOf({}, {robot("scout", path)}),
              AllOf(HasSubstr("[robot.scout] rawlog"), HasSubstr("(r1, r2)")));
  table_ = {};
  EXPECT_EQ(errorOf({}, {robot("r1", path)}), "no error") << "one of them is named";
}

TEST_F(RawlogSourceTest, NoRawlogAndMissingFilesAreErrors) {
  EXPECT_THAT(errorOf({}), HasSubstr("no rawlog"));
  EXPECT_THAT(errorOf({folder_ + "/gone.rawlog"}), HasSubstr("gone.rawlog: no such file"));
}

TEST_F(RawlogSourceTest, MergesFilesInTimeOrder) {
  const auto a = write("a.rawlog", {wheels(1, "o"), wheels(3, "o"), wheels(5, "o")});
  const auto b = write("b.rawlog", {wheels(2, "o"), wheels(4, "o")});
  RawlogSource source({a, b}, {}, table_);
  EXPECT_THAT(drain(source), ElementsAre("a:o@10", "b:o@20", "a:o@30", "b:o@40", "a:o@50"));
}

TEST_F(RawlogSourceTest, SortsWhatWasWrittenLate) {
  const auto path = write("a.rawlog", {wheels(1, "o"), wheels(1.5, "o"), cloud(1.2, "l"),
                                       wheels(9, "o"), cloud(8.9, "l")});
  RawlogSource source({path}, {}, table_);
  EXPECT_THAT(drain(source), ElementsAre("a:o@10", "a:l@12", "a:o@15", "a:l@89", "a:o@90"));
}

TEST_F(RawlogSourceTest, DropsRepeatedAndBackwardStamps) {
  const auto path = write("a.rawlog", {wheels(1, "o"), wheels(1, "o"), wheels(2, "o"),
                                       wheels(1.5, "o"), cloud(1, "o"), wheels(3, "o")});
  RawlogSource source({path}, {}, table_);
  EXPECT_THAT(drain(source), ElementsAre("a:o@10", "a:o@10", "a:o@20", "a:o@30"));
  const LabelReport& report = source.robots().at(0).labels.at(0);
  EXPECT_EQ(report.used, 3u);
  EXPECT_EQ(report.repeated, 1u);
  EXPECT_EQ(report.backwards, 1u);
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("repeats the one before")));
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("goes back in time")));
}

/** Odometry and a lidar, ten of each a second. */
Objects drive(double begin, double end) {
  Objects objects;
  for (int i = 0; begin + 0.1 * i < end - 0.01; ++i) {
    objects.push_back(wheels(begin + 0.1 * i, "o"));
    objects.push_back(cloud(begin + 0.1 * i + 0.03, "l", 1));
  }
  return objects;
}

Objects joined(Objects first, const Objects& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

TEST_F(RawlogSourceTest, OneStampInTheFutureCostsOneObservation) {
  for (const double ahead : {0.5, 5.0, 86400.0})
    for (const size_t at : {0, 1, 30, 41}) {
      Objects objects = drive(100, 104);
      auto& stamp = std::dynamic_pointer_cast<mrpt::obs::CObservation>(objects.at(at))->timestamp;
      stamp = mrpt::Clock::fromDouble(mrpt::Clock::toDouble(stamp) + ahead);
      table_ = {};
      RawlogSource source({write("a.rawlog", objects)}, {}, table_);
      const auto seen = drain(source);
      EXPECT_EQ(seen.size(), objects.size() - 1) << "observation " << at << ", ahead by " << ahead;
      EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
        return a.substr(a.find('@')) < b.substr(b.find('@'));
      }));
      EXPECT_THAT(source.warnings(),
                  ElementsAre(AllOf(HasSubstr("1 observation dropped"), HasSubstr("lies ahead"))));
    }
}

TEST_F(RawlogSourceTest, AClockThatIsSetBackGoesOn) {
  for (const double back : {3.0, 3600.0}) {
    const Objects objects = joined(drive(10000, 10004), drive(10004 - back, 10008 - back));
    table_ = {};
    RawlogSource source({write("a.rawlog", objects)}, {}, table_);
    size_t count = 0;
    double last = 0;
    while (const auto o = source.next()) {
      EXPECT_GE(o->stamp, last);
      EXPECT_EQ(mrpt::Clock::toDouble(o->observation->timestamp), o->stamp);
      last = o->stamp;
      ++count;
    }
    EXPECT_EQ(count, objects.size());
    EXPECT_NEAR(last, 10007.93, 0.1);
    EXPECT_THAT(source.warnings(), ElementsAre(HasSubstr("the clock was set back")));
  }
}

TEST_F(RawlogSourceTest, ARecordingThatRepeatsItselfIsNoClockSetBack) {
  const Objects once = drive(100, 104);
  RawlogSource source({write("a.rawlog", joined(once, once))}, {}, table_);
  EXPECT_EQ(drain(source).size(), once.size());
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("goes back in time")));
}

TEST_F(RawlogSourceTest, OneSensorThatFallsBehindDoesNotMoveTheOthers) {
  Objects objects = drive(100, 104);
  for (const auto& object : drive(104, 108)) {
    auto& o = *std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
    if (o.sensorLabel == "l")
      o.timestamp = mrpt::Clock::fromDouble(mrpt::Clock::toDouble(o.timestamp) - 60);
    objects.push_back(object);
  }
  RawlogSource source({write("a.rawlog", objects)}, {}, table_);
  EXPECT_EQ(drain(source).size(), 40u + 80u);
  EXPECT_THAT(source.warnings(), ElementsAre(HasSubstr("goes back in time")));
}

TEST_F(RawlogSourceTest, OdometryLabelChooses) {
  const auto path = write("a.rawlog", {wheels(1, "wheels"), wheels(2, "visual"), cloud(2, "l")});
  auto options = robot("a", path);
  {
    RawlogSource source({}, {options}, table_);
    EXPECT_THAT(drain(source), ElementsAre("a:wheels@10", "a:l@20"));
    EXPECT_THAT(source.warnings(), ElementsAre(HasSubstr("label 'visual'")));
  }
  table_ = {};
  options.odometry_label = "visual";
  {
    RawlogSource source({}, {options}, table_);
    EXPECT_THAT(drain(source), ElementsAre("a:visual@20", "a:l@20"));
    EXPECT_THAT(source.warnings(), IsEmpty());
  }
  table_ = {};
  options.odometry_label = "visul";
  RawlogSource source({}, {options}, table_);
  EXPECT_THAT(drain(source), ElementsAre("a:l@20"));
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("'visul' of odometry_label; there are "
                                                    "'wheels', 'visual'")));
}

TEST_F(RawlogSourceTest, LidarLabelsChoose) {
  const auto path = write("a.rawlog", {wheels(1, "o"), cloud(2, "top"), cloud(3, "rear")});
  auto options = robot("a", path);
  options.lidar_labels = {"top", "front"};
  RawlogSource source({}, {options}, table_);
  EXPECT_THAT(drain(source), ElementsAre("a:o@10", "a:top@20"));
  EXPECT_THAT(source.warnings(),
              ElementsAre(HasSubstr("'front' of lidar_labels; there are 'top', 'rear'")));
}

TEST_F(RawlogSourceTest, OdometryFileReplacesTheRecordedOne) {
  const auto path = write("a.rawlog", {wheels(1, "o"), cloud(2, "l"), wheels(3, "o")});
  writeFile(folder_ + "/a.tum", "0.5 1 0 0 0 0 0 1\n2 4 5 6 0 0 0 1\n");
  auto options = robot("a", path);
  options.odometry_file = folder_ + "/a.tum";
  RawlogSource source({}, {options}, table_);
  const auto first = source.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(odometryFromObservation(*first->observation)->odom_T_base.translation().x(), 1);
  EXPECT_THAT(drain(source), ElementsAre("a:odometry_file@20", "a:l@20"));
  EXPECT_THAT(source.warnings(), IsEmpty());
}

TEST_F(RawlogSourceTest, SaysWhatIsMissing) {
  const auto a = write("a.rawlog", {wheels(1, "o")});
  const auto b = write("b.rawlog", {cloud(1, "l")});
  RawlogSource source({a, b}, {}, table_);
  drain(source);
  EXPECT_THAT(source.warnings(), ElementsAre("robot 'a': no lidar scan", "robot 'b': no odometry"));
}

TEST_F(RawlogSourceTest, SaysWhereOdometryIsOfAnotherTime) {
  const auto path = write("a.rawlog", {cloud(1600000000, "l"), cloud(1600000005, "l")});
  writeFile(folder_ + "/a.tum", "0.5 1 0 0 0 0 0 1\n2 4 5 6 0 0 0 1\n");
  auto options = robot("a", path);
  options.odometry_file = folder_ + "/a.tum";
  RawlogSource source({}, {options}, table_);
  drain(source);
  EXPECT_THAT(source.warnings(), ElementsAre(AllOf(HasSubstr("from 1600000000.000 to"),
                                                   HasSubstr("odometry from 0.500 to 2.000"))));
}

TEST_F(RawlogSourceTest, TellsOfDamage) {
  const std::string path = folder_ + "/a.rawlog";
  writeFile(path, bytesOf(*wheels(1, "o")) + foreignObject("vendor::CThing", "abc") +
                      bytesOf(*cloud(2, "l")) + bytesOf(*cloud(3, "l")).substr(0, 500));
  RawlogSource source({path}, {}, table_);
  EXPECT_THAT(drain(source), ElementsAre("a:o@10", "a:l@20"));
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("unknown class vendor::CThing")));
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("cut off")));
  EXPECT_TRUE(source.recordings().at(0).file.truncated);
}

TEST_F(RawlogSourceTest, LoadsExternalCloudsFromEachRawlogsFolder) {
  using Format = mrpt::obs::CObservationPointCloud::ExternalStorageFormat;
  std::vector<std::string> paths;
  for (const std::string name : {"one", "two"}) {
    const std::string images = folder_ + "/" + name + "_Images";
    std::filesystem::create_directories(images);
    auto o = cloud(1, "lidar");
    auto gone = cloud(2, "lidar");
    // Same name in both: the folder decides.
    writeFile(images + "/scan.txt", name == "one" ? "1 0 0\n2 0 0\n" : "7 0 0\n");
    o->setAsExternalStorage("scan.txt", Format::PlainTextFile);
    gone->setAsExternalStorage("gone.txt", Format::PlainTextFile);
    paths.push_back(write(name + ".rawlog", {o, gone}));
  }
  RawlogSource source(paths, {}, table_);
  const auto one = source.next(), two = source.next();
  ASSERT_TRUE(one && two);
  EXPECT_FALSE(source.next());
  EXPECT_EQ(scanFromObservation(*one->observation, "lidar", {})->size(), 2u);
  const auto scan = scanFromObservation(*two->observation, "lidar", {});
  ASSERT_EQ(scan->size(), 1u);
  EXPECT_EQ(scan->points[0].x(), 7);
  EXPECT_THAT(source.warnings(), Contains(HasSubstr("data file is missing")));
}

/** A cloud and a depth image whose data lie in the given files. */
Objects withExternalFiles(const std::string& cloud_file, const std::string& points_file,
                          const std::string& ranges_file) {
  auto o = cloud(1, "lidar");
  o->setAsExternalStorage(
      cloud_file, mrpt::obs::CObservationPointCloud::ExternalStorageFormat::MRPT_Serialization);
  auto depth = mrpt::obs::CObservation3DRangeScan::Create();
  depth->timestamp = mrpt::Clock::fromDouble(2);
  depth->sensorLabel = "depth";
  depth->hasPoints3D = depth->hasRangeImage = true;
  depth->resizePoints3DVectors(3);
  depth->rangeImage_setSize(2, 2);
  depth->points3D_convertToExternalStorage(points_file, "");
  depth->rangeImage_convertToExternalStorage(ranges_file, "");
  return {o, depth};
}

TEST_F(RawlogSourceTest, LoadsExternalObjectsOnlyIfTheirSizesAreRight) {
  const std::string clouds = folder_ + "/cloud.bin", points = folder_ + "/points.bin",
                    ranges = folder_ + "/ranges.bin";
  const std::string path = write("a.rawlog", withExternalFiles(clouds, points, ranges));
  const std::string whole = bytesOf(*cloud(1, "")->pointcloud);
  const auto loaded = [&] {
    RawlogSource source({path}, {}, table_);
    return drain(source);
  };
  writeFile(clouds, whole);
  EXPECT_THAT(loaded(), ElementsAre("a:lidar@10", "a:depth@20"));
  const std::string points_whole = readFile(points), ranges_whole = readFile(ranges);

  const size_t size = whole.find(std::string("\x64\0\0\0", 4));  // 100 points
  ASSERT_NE(size, std::string::npos);
  writeFile(clouds, std::string(whole).replace(size, 4, "\xff\xff\xff\x7f"));
  EXPECT_THAT(loaded(), ElementsAre("a:depth@20"));
  writeFile(clouds, whole);
  writeFile(points, "\xff\xff\xff\x7f" + points_whole);
  EXPECT_THAT(loaded(), ElementsAre("a:lidar@10"));
  writeFile(points, points_whole);
  writeFile(ranges, "\xff\xff\xff\x7f\xff\xff\xff\x7f");
  EXPECT_THAT(loaded(), ElementsAre("a:lidar@10"));
  writeFile(ranges, ranges_whole);
  EXPECT_THAT(loaded(), ElementsAre("a:lidar@10", "a:depth@20"));
}

}  // namespace
}  // namespace lamp
