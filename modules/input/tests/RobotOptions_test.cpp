#include "lamp/input/RobotOptions.h"

#include <gtest/gtest.h>

#include "lamp/core/Ini.h"

namespace lamp {
namespace {

RobotOptions read(const std::string& text, Faults& faults) {
  const Ini ini = Ini::fromText("[robot.husky]\n" + text, "test.ini", faults);
  RobotOptions options;
  readOptions(ini.find("robot.husky"), options, faults);
  return options;
}

TEST(RobotOptions, ReadsWhatTheIniSays) {
  Faults faults;
  const auto options = read(
      "rawlog = husky.rawlog\nkey = h\nstart_pose = [1 2 3 90 0 0]\nstart_sigma_xyz_m = 0.1\n"
      "lidar_labels = top, rear\n",
      faults);
  faults.throwIfAny();
  EXPECT_EQ(options.rawlog, "husky.rawlog");
  EXPECT_EQ(options.start_pose, (std::vector<double>{1, 2, 3, 90, 0, 0}));
  EXPECT_EQ(options.start_sigma_xyz_m, 0.1);
  EXPECT_EQ(options.start_sigma_rot_deg, 0) << "0 means not set";
  EXPECT_EQ(options.lidar_labels, (std::vector<std::string>{"top", "rear"}));
}

TEST(RobotOptions, ReportsFaults) {
  Faults faults;
  read("start_pose = [1 2 3]\nstart_sigma_rot_deg = -1\nrawlg = x\n", faults);
  EXPECT_EQ(faults.list().size(), 3u);
}

}  // namespace
}  // namespace lamp
