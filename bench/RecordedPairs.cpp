#include "RecordedPairs.h"

#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "lamp/core/ScanOverlap.h"
#include "lamp/core/Trajectory.h"
#include "lamp/input/OdometryFromObservation.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/input/ScanFromObservation.h"
#include "lamp/scans/VoxelFilter.h"

namespace lamp {

namespace {

constexpr double kLongestTimeBetween_s = 15;
/** Scans are taken alone: there is nothing to thin. */
constexpr double kNoNeighbors_m = 1;

struct PosedScan {
  double stamp = 0;
  KeyedScanPtr thinned;
  std::unique_ptr<OverlapScan> all;
  Pose3 odom_T_base = Pose3::Identity();
};
using Recording = std::vector<PosedScan>;

PosedScan posedScan(const Scan& scan, double stamp) {
  AdaptiveVoxelOptions options;
  options.min_leaf_m = 0.05;
  options.max_leaf_m = 2;
  options.max_passes = 10;
  PosedScan result;
  result.stamp = stamp;
  result.thinned = std::make_shared<Scan>(AdaptiveVoxelFilter(options).filter(scan));
  result.all = std::make_unique<OverlapScan>(scan.points, false);
  return result;
}

/** The scans of each robot, at the poses of its odometry. */
std::vector<Recording> readRecordings(const std::vector<std::string>& rawlogs) {
  RobotTable robots;
  RawlogSource source(rawlogs, {}, robots);
  std::map<RobotId, Recording> scans;
  std::map<RobotId, std::vector<StampedPose>> odometry;
  while (const auto input = source.next()) {
    if (const auto reading = odometryFromObservation(*input->observation))
      odometry[input->robot].push_back({reading->stamp, reading->odom_T_base});
    else if (const auto scan = scanFromObservation(*input->observation, input->label, {}))
      scans[input->robot].push_back(posedScan(*scan, input->stamp));
  }
  std::vector<Recording> recordings;
  for (auto& [robot, recording] : scans) {
    const TrajectoryInterpolator trajectory(odometry.at(robot));
    for (PosedScan& scan : recording) scan.odom_T_base = trajectory.at(scan.stamp);
    recordings.push_back(std::move(recording));
  }
  return recordings;
}

/** Any yaw, up to 10 m, and what a robot on rough ground adds. */
Pose3 randomMotion(std::mt19937& random) {
  constexpr double kOffset_m = 10, kHeight_m = 1, kTilt = 5 * M_PI / 180;
  const auto within = [&](double limit) {
    return std::uniform_real_distribution<double>(-limit, limit)(random);
  };
  const double yaw = within(M_PI), bearing = within(M_PI), offset = kOffset_m * std::abs(within(1));
  Vector6d xyz_ypr;
  xyz_ypr << offset * std::cos(bearing), offset * std::sin(bearing), within(kHeight_m), yaw,
      within(kTilt), within(kTilt);
  return poseFromYawPitchRoll(xyz_ypr);
}

using ScanPair = std::pair<const PosedScan*, const PosedScan*>;

std::vector<ScanPair> shuffledPairs(const std::vector<Recording>& recordings,
                                    std::mt19937& random) {
  std::vector<ScanPair> pairs;
  for (const Recording& recording : recordings)
    for (size_t j = 0; j < recording.size(); ++j)
      for (size_t i = 0; i < j; ++i)
        if (recording[j].stamp - recording[i].stamp <= kLongestTimeBetween_s)
          pairs.emplace_back(&recording[i], &recording[j]);
  for (size_t i = pairs.size(); i > 1; --i) std::swap(pairs[i - 1], pairs[random() % i]);
  return pairs;
}

RecordedPair movedPair(const ScanPair& scans, double overlap, std::mt19937& random) {
  const Pose3 motion = randomMotion(random);
  RecordedPair pair;
  pair.target = accumulate({{scans.first->thinned, Pose3::Identity()}}, kNoNeighbors_m);
  pair.source = accumulate({{scans.second->thinned, motion}}, kNoNeighbors_m);
  pair.target_T_source =
      scans.first->odom_T_base.inverse() * scans.second->odom_T_base * motion.inverse();
  pair.overlap = overlap;
  return pair;
}

}  // namespace

std::vector<RecordedPair> recordedPairs(const std::vector<std::string>& rawlogs,
                                        const std::vector<OverlapClass>& classes, size_t count,
                                        unsigned seed) {
  const std::vector<Recording> recordings = readRecordings(rawlogs);
  std::mt19937 random(seed);
  std::vector<std::vector<RecordedPair>> chosen(classes.size());
  for (const ScanPair& scans : shuffledPairs(recordings, random)) {
    const auto& [a, b] = scans;
    const double overlap = scanOverlap(*a->all, *b->all, a->odom_T_base.inverse() * b->odom_T_base);
    bool complete = true;
    for (size_t k = 0; k < classes.size(); ++k) {
      const bool fits = overlap >= classes[k].least && overlap < classes[k].below;
      if (fits && chosen[k].size() < count) chosen[k].push_back(movedPair(scans, overlap, random));
      complete = complete && chosen[k].size() == count;
    }
    if (complete) break;
  }
  std::vector<RecordedPair> pairs;
  for (const auto& some : chosen) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

}  // namespace lamp
