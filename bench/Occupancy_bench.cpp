// Keyed scans into the occupancy map, beside MRPT's COctoMap: the same 3000 points each of a
// simulated mine, voxel size and range. One thread.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <tbb/global_control.h>

#include <memory>

#include "OccupancyMap.h"
#include "VoxelStates.h"
#include "lamp/core/Trajectory.h"
#include "lamp/simulation/Drive.h"
#include "lamp/simulation/FiringPattern.h"
#include "lamp/simulation/World.h"

namespace lamp {
namespace {

constexpr OccupancyMap::Options kOptions;
constexpr size_t kPoints = 3000;
const Eigen::Vector3f kEye(0, 0, 0.8f);  ///< of the lidar, in the base frame

/** Points evenly spread over one revolution, as a voxel filter leaves them. */
std::shared_ptr<Scan> lookFrom(const Pose3& world_T_base, const simulation::RayCaster& caster) {
  constexpr int kSequences = 900, kLasers = simulation::FiringPattern::kLasers;
  constexpr int kRays = kSequences * kLasers, kStride = 13;  // coprime: each ray once
  static const simulation::FiringPattern kPattern(kSequences, 10, 1);
  const Eigen::Isometry3f pose = world_T_base.cast<float>();
  auto scan = std::make_shared<Scan>();
  scan->sensors = {{"lidar", kEye.cast<double>()}};
  for (int i = 0; i < kRays && scan->size() < kPoints; ++i) {
    const int ray = i * kStride % kRays;
    const Eigen::Vector3f direction = kPattern.direction(ray / kLasers, ray % kLasers);
    const auto hit = caster.cast(pose * kEye, pose.linear() * direction, 100);
    if (hit) scan->points.push_back(kEye + hit->range_m * direction);
  }
  scan->sensor.assign(scan->size(), 0);
  return scan;
}

/** What a robot sees every two seconds of a way. */
ComponentMap recordedMap() {
  const auto& kind = simulation::worldKind("tunnel");
  const simulation::World world = kind.make(300, kind.cell_m, 1);
  const simulation::RayCaster caster(world.mesh);
  const TrajectoryInterpolator way(simulation::drive(
      simulation::planRoutes(world.layout, {200}, 1)[0], caster, simulation::DriveOptions(), 0, 1));
  ComponentMap map;
  for (double stamp = way.begin(); stamp < way.end(); stamp += 2) {
    const Pose3 pose = way.at(stamp);
    const KeyNodeId id{RobotId{0}, static_cast<uint32_t>(map.key_nodes.size())};
    map.key_nodes.push_back({id, stamp, pose, lookFrom(pose, caster)});
  }
  return map;
}

const ComponentMap& recorded() {
  static const ComponentMap map = recordedMap();
  return map;
}

/** Counts scans as items, and states the time of one. */
void perScan(benchmark::State& state) {
  const auto scans = static_cast<double>(recorded().key_nodes.size());
  state.counters["scans"] = scans;
  state.counters["s_per_scan"] = benchmark::Counter(
      scans, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/** To the state of each voxel, as MRPT's map has it. */
void lampFromNothing(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const ComponentMap& map = recorded();
  for (auto _ : state) {
    OccupancyMap occupancy(kOptions);
    occupancy.update(map);
    const OccupancyCounts& counts = occupancy.counts();
    benchmark::DoNotOptimize(classify(counts, occupiedVoxels(counts), {}).size());
  }
  perScan(state);
}

/** A loop closure moves a tenth of the key nodes, and the next one moves them back. */
void lampATenthMoves(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  ComponentMap moved = recorded();
  for (size_t i = 0; i < moved.key_nodes.size() / 10; ++i)
    moved.key_nodes[i].world_T_base.pretranslate(Eigen::Vector3d(0.3, 0.1, 0));
  OccupancyMap occupancy(kOptions);
  occupancy.update(recorded());
  bool is_moved = false;
  for (auto _ : state) {
    is_moved = !is_moved;
    occupancy.update(is_moved ? moved : recorded());
  }
}

mrpt::obs::CObservationPointCloud observationOf(const Scan& scan) {
  auto points = mrpt::maps::CSimplePointsMap::Create();
  for (const Eigen::Vector3f& point : scan.points) {
    const Eigen::Vector3f ray = point - kEye;
    points->insertPoint(ray.x(), ray.y(), ray.z());
  }
  mrpt::obs::CObservationPointCloud observation;
  observation.pointcloud = points;
  observation.sensorPose = mrpt::poses::CPose3D(kEye.x(), kEye.y(), kEye.z(), 0, 0, 0);
  return observation;
}

void mrptFromNothing(benchmark::State& state) {
  std::vector<mrpt::obs::CObservationPointCloud> observations;
  std::vector<mrpt::poses::CPose3D> poses;
  for (const MapKeyNode& key_node : recorded().key_nodes) {
    observations.push_back(observationOf(*key_node.scan));
    poses.emplace_back(mrpt::math::CMatrixDouble44(key_node.world_T_base.matrix()));
  }
  for (auto _ : state) {
    mrpt::maps::COctoMap octomap(kOptions.resolution_m);
    octomap.insertionOptions.maxrange = kOptions.max_range_m;
    for (size_t i = 0; i < observations.size(); ++i)
      if (!octomap.insertObservation(observations[i], poses[i]))
        return state.SkipWithError("COctoMap does not take the scan");
    benchmark::DoNotOptimize(octomap.isEmpty());
  }
  perScan(state);
}

BENCHMARK(lampFromNothing)->Unit(benchmark::kMillisecond);
BENCHMARK(lampATenthMoves)->Unit(benchmark::kMillisecond);
BENCHMARK(mrptFromNothing)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamp
