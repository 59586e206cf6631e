#include "lamp/input/RobotOptions.h"

namespace lamp {

void RobotOptions::visit(OptionVisitor& v) {
  v("rawlog", rawlog,
    "recording of this robot, whatever robot its labels name; empty where its observations are "
    "found by the label's part before the first slash");
  v("key", key, "the robot's letter in 64-bit symbols; empty takes the next free one");
  v("calibration", calibration,
    "how the start pose is measured: not, or by the plates of [gate], before which the robot "
    "stands "
    "at the beginning; if they do not tell, start_pose counts",
    {"none", "gate"});
  v("start_pose", start_pose, 6, "m, deg",
    "pose of the base in the world at the first key node, [x y z yaw pitch roll]; empty if "
    "unknown");
  v("start_sigma_xyz_m", start_sigma_xyz_m, "m",
    "standard deviation of the start position along each axis; 0 uses the front end's default",
    kNotNegative);
  v("start_sigma_rot_deg", start_sigma_rot_deg, "deg",
    "standard deviation of the start rotation about each axis; 0 uses the front end's default",
    kNotNegative);
  v("odometry_file", odometry_file,
    "TUM trajectory to use instead of the recorded odometry; empty uses the recorded one");
  v("odometry_label", odometry_label,
    "sensor label of the odometry to use; empty uses the first odometry in the recording");
  v("lidar_labels", lidar_labels, "sensor labels of the lidars to use; empty uses all of them");
  v("arrivals", arrivals,
    "CSV file with columns stamp and arrival: when this robot's key nodes reach the base station");
  v("beacon_id", beacon_id, "",
    "number of the radio beacon carried by this robot; -1 if it carries none", {-1});
  v("beacon_position", beacon_position, 3, "m",
    "position of the beacon in the base frame; empty means the origin");
}

void BeaconOptions::visit(OptionVisitor& v) {
  v("id", id, "", "number of the beacon in recorded distances", kNotNegative);
  v("position", position, 3, "m",
    "position of the beacon in the world; empty if it is to be estimated");
}

}  // namespace lamp
