#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/frontend/ExtrasCollector.h"
#include "lamp/frontend/MotionModel.h"
#include "lamp/frontend/OdometrySource.h"
#include "lamp/frontend/ScanAssembler.h"
#include "lamp/input/ScanFromObservation.h"
#include "lamp/scans/VoxelFilter.h"

namespace lamp {

class ApertureCheck;
class OdometryChain;
class PassedScans;
class ScanMerger;
class StandstillCheck;

struct FrontEndOptions {
  bool keyed = false;
  double key_node_distance_m = 2.0;
  double key_node_angle_deg = 30.0;
  double merge_window_s = 0.2;
  ScanOptions scan;
  AdaptiveVoxelOptions voxel;
  MotionModelOptions motion;
  GravityOptions gravity;

  void visit(OptionVisitor& v);
};

/** The single-robot front end (paper II-B): turns one robot's observations into a sparse pose graph
 * segment with keyed scans.
 *
 * Input that is keyed already passes unchanged: each lidar stamp is a key node, and its points are
 * neither filtered nor cut at the range limits, which whoever keyed them has done. */
class FrontEnd {
 public:
  /** \param odometry sources, in order of preference. */
  FrontEnd(RobotId robot, const FrontEndOptions& options,
           std::vector<std::shared_ptr<OdometrySource>> odometry, std::optional<StartPrior> prior);
  ~FrontEnd();

  /** \return the key nodes that the observation completes, in time order. */
  std::vector<KeyNodePacket> observe(const InputObservation& observation);
  /** Nothing of the robot before `stamp` (seconds, UTC) will come.
   *  \return the key nodes that are complete by this. */
  std::vector<KeyNodePacket> advanceTo(double stamp);
  /** Handles what still waits for odometry, and closes the stream. */
  std::vector<KeyNodePacket> finish();
  /** What came after the last key node; to be called after finish(). */
  RobotEnd end();

  struct Counts {
    size_t scans = 0;  ///< of the reference lidar, or keyed scans
    size_t key_nodes = 0;
    size_t empty_scans = 0;       ///< no usable point where a key node was due
    size_t without_odometry = 0;  ///< scans that no odometry covers
    size_t contradicted = 0;      ///< scans that move while odometry stands
    size_t tracked_scans = 0;     ///< whose pose comes from scan odometry
  };
  const Counts& counts() const { return counts_; }
  std::vector<std::string> warnings() const;

 private:
  void enqueue(ScanParts scan);
  std::vector<KeyNodePacket> processCoveredScans();
  std::optional<KeyNodePacket> processScan(const ScanParts& parts);
  bool placed(const ScanParts& parts, const Pose3& odom_T_base);
  void checkAperture(const ScanParts& parts);
  void checkTilt(const InputObservation& part);
  void dropWithoutOdometry(double stamp);
  void leaveOut(double begin, double end, double sigma_m_per_s, double sigma_rad_per_s);
  bool planar() const;
  Pose3 odometryPose(double stamp);
  Scan merged(const ScanParts& parts);
  Scan filtered(Scan scan);
  Pose3 track(double stamp, Scan& filtered);
  std::optional<KeyNodePacket> processPose(const ScanParts& parts, const Pose3& odom_T_base,
                                           std::optional<Scan> scan);
  bool isKeyNode(const Pose3& odom_T_base) const;
  bool believes(const GravityReading& gravity, const Pose3& odom_T_base);
  KeyNodeExtras takeExtras(const Pose3& odom_T_base);
  KeyNodePacket makePacket(double stamp, const Pose3& odom_T_base, Scan scan);
  Matrix6d motionCovariance(double stamp);

  const RobotId robot_;
  const FrontEndOptions options_;
  const std::unique_ptr<OdometryChain> odometry_;
  const std::optional<StartPrior> prior_;
  const std::unique_ptr<ScanAssembler> assembler_;
  const std::unique_ptr<ScanMerger> merger_;
  AdaptiveVoxelFilter voxel_filter_;

  const std::unique_ptr<StandstillCheck> standstill_;
  const std::unique_ptr<ApertureCheck> aperture_;

  std::deque<ScanParts> waiting_;
  ExtrasCollector extras_;

  std::optional<StampedPose> last_key_;
  std::optional<Pose3> last_scan_pose_;
  Path path_since_key_;
  const std::unique_ptr<PassedScans> passed_scans_;
  double last_stamp_ = 0;  ///< of the last scan, seconds, UTC
  /** Standard deviations of the motion since the last key node that nobody measured. */
  struct Unmeasured {
    double sigma_m = 0, sigma_rad = 0;
  } unmeasured_;
  std::optional<Pose3> first_pose_;
  bool planar_lidar_ = true;
  std::map<std::string, double> tilted_lasers_;  ///< by label, radians
  double median_range_m_ = 0;                    ///< of the last keyed scan of a robot in the plane
  std::optional<bool> gravity_believed_;         ///< by the first reading
  double gravity_deviation_ = 0;                 ///< of that from upright, radians
  std::optional<Pose3> world_T_odom_;            ///< by the start pose
  Counts counts_;
  double first_without_odometry_ = 0;  ///< stamp, seconds, UTC
};

}  // namespace lamp
