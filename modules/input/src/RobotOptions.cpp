#include "lamp/input/RobotOptions.h"

namespace lamp {

void RobotOptions::visit(OptionVisitor& v) {
  v("rawlog", rawlog,
    "recording of this robot; empty where its observations are found by the label's part before "
    "the first slash");
  v("key", key, "letter of the robot in 64-bit symbols; empty for the next free one");
  v("start_pose", start_pose, 6, "m, deg",
    "pose of the base in the world at the first key node, [x y z yaw pitch roll]; empty if "
    "unknown");
  v("start_sigma_xyz_m", start_sigma_xyz_m, "m",
    "standard deviation of the start position on each axis; 0 for the default of the front end",
    kNotNegative);
  v("start_sigma_rot_deg", start_sigma_rot_deg, "deg",
    "standard deviation of the start rotation about each axis; 0 for the default of the front "
    "end",
    kNotNegative);
  v("odometry_file", odometry_file,
    "TUM trajectory that is used instead of the recorded odometry; empty for the recorded one");
  v("odometry_label", odometry_label,
    "sensor label of the odometry to use; empty for the first odometry in the recording");
  v("lidar_labels", lidar_labels, "sensor labels of the lidars to use; empty for every lidar");
  v("arrivals", arrivals,
    "CSV file with columns stamp and arrival: when this robot's key nodes reach the base station");
  v("beacon_id", beacon_id, "",
    "number of the radio beacon on this robot, to which others measure distances; -1 for none",
    {-1});
  v("beacon_position", beacon_position, 3, "m",
    "where the beacon sits in the base frame; empty for its origin");
}

void BeaconOptions::visit(OptionVisitor& v) {
  v("id", id, "", "number of the beacon in recorded distances", kNotNegative);
  v("position", position, 3, "m",
    "where the beacon stands in the world; empty if it is to be found out");
}

}  // namespace lamp
