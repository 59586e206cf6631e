#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lamp {

/** A lidar on a robot: where its rays start in the scan's frame. */
struct SensorOrigin {
  std::string label;                                   ///< sensor label without the robot
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< base_p_sensor, metres
};

/** Point cloud of one scan in the robot's base frame at the scan's stamp.
 *
 * `intensity` and `time` are empty or as long as `points`; `sensor` is always as long as `points`
 * and indexes `sensors`, so that maps can carve free space along the true rays. A keyed scan, which
 * stands for one instant, has no times.
 */
struct Scan {
  std::vector<Eigen::Vector3f> points;  ///< base frame, metres
  std::vector<float> intensity;
  std::vector<float> time;  ///< when each point was measured, seconds since the scan's stamp
  std::vector<uint8_t> sensor;
  std::vector<SensorOrigin> sensors;

  size_t size() const { return points.size(); }
  bool hasIntensity() const { return !intensity.empty(); }
  bool hasTimes() const { return !time.empty(); }
};

/** The pre-processed scan of a key node (paper II-B); shared and never changed once made. */
using KeyedScanPtr = std::shared_ptr<const Scan>;

}  // namespace lamp
