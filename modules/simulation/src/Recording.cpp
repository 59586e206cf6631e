#include "lamp/simulation/Recording.h"

#include <mrpt/obs/CObservationBearingRange.h>
#include <mrpt/obs/CObservationIMU.h>
#include <mrpt/obs/CObservationRobotPose.h>
#include <mrpt/obs/CObservationVelodyneScan.h>
#include <mrpt/obs/CObservationWirelessPower.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "lamp/core/MrptFile.h"
#include "lamp/core/ScanObservation.h"
#include "lamp/simulation/SensorObservations.h"
#include "lamp/simulation/VelodyneObservation.h"

namespace lamp::simulation {

namespace {

/** Observations that wait for their turn in time. */
class Timeline {
 public:
  void add(double stamp, mrpt::obs::CObservation::Ptr observation) {
    entries_.push_back({stamp, std::move(observation)});
  }
  /** Hands over, in time order, what is older than `stamp`. Of equal stamps the first added goes
   * first. */
  void flushBefore(double stamp, const MrptSink& sink) {
    const auto earlier = [](const Entry& a, const Entry& b) { return a.stamp < b.stamp; };
    std::stable_sort(entries_.begin(), entries_.end(), earlier);
    const auto end =
        std::lower_bound(entries_.begin(), entries_.end(), Entry{stamp, nullptr}, earlier);
    for (auto entry = entries_.begin(); entry != end; ++entry) sink(*entry->observation);
    entries_.erase(entries_.begin(), end);
  }
  void flush(const MrptSink& sink) { flushBefore(std::numeric_limits<double>::infinity(), sink); }

 private:
  struct Entry {
    double stamp;
    mrpt::obs::CObservation::Ptr observation;
  };
  std::vector<Entry> entries_;
};

void addRadioAndArtifacts(const MissionRobot& robot, const Mission& mission,
                          const SimConfig& config, Timeline& timeline) {
  for (const RssiReading& reading : robot.rssi)
    timeline.add(reading.stamp, rssiObservation(reading, mission.beacons[reading.beacon],
                                                robot.name, config.radio.antenna_m));
  for (const auto& observation :
       artifactObservations(robot.sightings, config.artifacts, robot.name))
    timeline.add(mrpt::Clock::toDouble(observation->timestamp), observation);
}

/** The last reading at or before a stamp, or the first of all. */
const ImuReading* imuAt(const MissionRobot& robot, double stamp) {
  const auto after =
      std::upper_bound(robot.imu.begin(), robot.imu.end(), stamp,
                       [](double t, const ImuReading& reading) { return t < reading.stamp; });
  if (robot.imu.empty()) return nullptr;
  return &*(after == robot.imu.begin() ? after : after - 1);
}

/** The observations of all lidars for one scan; each keeps its own stamp. */
std::vector<std::shared_ptr<mrpt::obs::CObservationVelodyneScan>> rawScan(
    const MissionRobot& robot, double stamp, SeenTriangles& seen,
    std::vector<Eigen::Vector3f>& moving) {
  std::vector<std::shared_ptr<mrpt::obs::CObservationVelodyneScan>> all;
  for (size_t i = 0; i < robot.lidars.size(); ++i) {
    const LidarSweep sweep = robot.lidars[i].sweep(robot.truth, stamp, lidarSeed(robot, i));
    markSeen(sweep, seen);
    appendMoving(sweep, robot.lidars[i], robot.truth, stamp, moving);
    for (auto& observation :
         velodyneObservations(sweep, robot.lidars[i], robot.name + "/" + robot.lidar_names[i]))
      all.push_back(std::move(observation));
  }
  return all;
}

}  // namespace

void writeKeyedRecording(const std::string& path, const MissionRobot& robot,
                         const std::vector<KeyedScanPtr>& scans, const Mission& mission,
                         const SimConfig& config) {
  Timeline timeline;
  for (size_t i = 0; i < scans.size(); ++i) {
    const double stamp = robot.stampOf(i);
    timeline.add(stamp, odometryObservation(robot.odometry, robot.key_nodes[i], robot.name));
    for (size_t sensor = 0; sensor < scans[i]->sensors.size(); ++sensor)
      timeline.add(stamp, mrpt::obs::CObservationPointCloud::Create(
                              scanObservation(*scans[i], sensor, robot.name, stamp)));
    if (const ImuReading* reading = imuAt(robot, stamp))
      timeline.add(reading->stamp, imuObservation(*reading, robot.name));
  }
  addRadioAndArtifacts(robot, mission, config, timeline);
  writeMrptFile(path, [&](const MrptSink& sink) { timeline.flush(sink); });
}

void writeRawRecording(const std::string& path, const MissionRobot& robot, const Mission& mission,
                       const SimConfig& config, SeenTriangles& seen, MovingPoints& moving,
                       const ShareDone& done) {
  constexpr size_t kChunk = 64;
  Timeline timeline;
  for (size_t i = 0; i < robot.odometry.odom_T_base.size(); ++i)
    timeline.add(robot.odometry.odom_T_base[i].stamp,
                 odometryObservation(robot.odometry, i, robot.name));
  for (const ImuReading& reading : robot.imu)
    timeline.add(reading.stamp, imuObservation(reading, robot.name));
  addRadioAndArtifacts(robot, mission, config, timeline);

  const std::vector<double> stamps = robot.scanStamps();
  writeMrptFile(path, [&](const MrptSink& sink) {
    for (size_t begin = 0; begin < stamps.size(); begin += kChunk) {
      const size_t end = std::min(begin + kChunk, stamps.size());
      std::vector<std::vector<std::shared_ptr<mrpt::obs::CObservationVelodyneScan>>> chunk(end -
                                                                                           begin);
      std::vector<std::vector<Eigen::Vector3f>> chunk_moving(chunk.size());
      tbb::parallel_for(begin, end, [&](size_t i) {
        chunk[i - begin] = rawScan(robot, stamps[i], seen, chunk_moving[i - begin]);
      });
      for (size_t i = 0; i < chunk.size(); ++i) {
        for (const auto& observation : chunk[i])
          timeline.add(mrpt::Clock::toDouble(observation->timestamp), observation);
        if (!chunk_moving[i].empty()) moving[begin + i] = std::move(chunk_moving[i]);
      }
      timeline.flushBefore(
          end < stamps.size() ? stamps[end] : std::numeric_limits<double>::infinity(), sink);
      done(static_cast<double>(end) / static_cast<double>(stamps.size()));
    }
  });
}

}  // namespace lamp::simulation
