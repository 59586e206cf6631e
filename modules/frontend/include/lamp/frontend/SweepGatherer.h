#pragma once

#include <bitset>
#include <optional>

#include "lamp/core/Geometry.h"
#include "lamp/core/KeyedScan.h"

namespace lamp {

/** Says which observations of one lidar make up one scan, where a driver cuts a sweep into pieces,
 * or a mount turns or nods the lidar.
 *
 * A lidar whose pose on the robot changes has seen all around after half a turn, as it sees both
 * sides, and a nodding one when it turns back. A lidar at rest has when it sees azimuths again that
 * it has seen. */
class SweepGatherer {
 public:
  /** \param longest_s a scan ends by then, whatever it covers. */
  explicit SweepGatherer(double longest_s = 2.0) : longest_s_(longest_s) {}

  /** Takes the observations of the lidar in time order.
   *  \param stamp seconds, UTC; \param base_T_sensor at the stamp; \param points in the base frame.
   *  \return whether the observation begins a scan: what came before it is complete. */
  bool begins(double stamp, const Pose3& base_T_sensor, const Scan& points);

  /** True once each observation has turned out to be a whole scan: then there is nothing to gather,
   * and nothing to wait for. It stays true. */
  bool wholeScans() const { return single_scans_ >= kSingleScans; }

 private:
  static constexpr int kSingleScans = 3;
  static constexpr int kAzimuths = 360;
  using Azimuths = std::bitset<kAzimuths>;

  bool hasComeRound(const Pose3& base_T_sensor, const Azimuths& seen);
  void noteScan();

  const double longest_s_;
  double begin_ = 0;  ///< stamp of the scan's first observation
  int observations_ = 0;
  int single_scans_ = 0;  ///< complete ones of one observation, in a row
  Azimuths seen_;
  std::optional<Pose3> last_pose_;
  double turned_rad_ = 0;
  Eigen::Vector3d axis_ =
      Eigen::Vector3d::Zero();  ///< about which the mount turns; zero if it rests
};

}  // namespace lamp
