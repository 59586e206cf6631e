// One keyed scan into the occupancy map, beside MRPT's COctoMap: 3000 points of a simulated mine,
// rays of 10 m, voxels of 0.2 m. One thread.
#include <benchmark/benchmark.h>
#include <mrpt/maps/COctoMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <tbb/global_control.h>

#include <memory>

#include "OccupancyMap.h"
#include "lamp/simulation/Drive.h"
#include "lamp/simulation/FiringPattern.h"
#include "lamp/simulation/World.h"

namespace lamp {
namespace {

constexpr double kRange = 10, kVoxel = 0.2;
constexpr size_t kPoints = 3000;

/** What a lidar sees from every two metres of a way. */
ComponentMap recordedMap() {
  const auto kind = simulation::worldKind("tunnel");
  const simulation::World world = kind.make(300, kind.cell_m, 1);
  const simulation::RayCaster caster(world.mesh);
  const TrajectoryInterpolator way = simulation::drive(
      simulation::planRoutes(world.layout, {200}, 1)[0], caster, simulation::DriveOptions(), 0, 1);
  const simulation::FiringPattern pattern(900, 10, 1);
  ComponentMap map;
  for (double stamp = way.begin(); stamp < way.end(); stamp += 2) {
    const Pose3 pose = way.at(stamp);
    auto scan = std::make_shared<Scan>();
    scan->sensors = {{"lidar", {0, 0, 0.8}}};
    const Eigen::Vector3f eye(0, 0, 0.8f);
    for (int i = 0; i < 900 * 16 && scan->size() < kPoints; i += 4) {
      const Eigen::Vector3f ray = pattern.direction(i / 16, (i * 7) % 16);
      const auto hit =
          caster.cast(pose.cast<float>() * eye, pose.linear().cast<float>() * ray, 100);
      if (!hit) continue;
      scan->points.push_back(eye + hit->range * ray);
      scan->sensor.push_back(0);
    }
    map.key_nodes.push_back(
        {{RobotId{0}, static_cast<uint32_t>(map.key_nodes.size())}, stamp, pose, scan});
  }
  return map;
}

const ComponentMap& recorded() {
  static const ComponentMap map = recordedMap();
  return map;
}

void perScan(benchmark::State& state, size_t scans) {
  state.SetItemsProcessed(static_cast<int64_t>(state.iterations() * scans));
  state.counters["scans"] = static_cast<double>(scans);
}

void lampFromNothing(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (auto _ : state) {
    OccupancyMap occupancy({kVoxel, kRange, 0});
    occupancy.update(recorded());
    benchmark::DoNotOptimize(occupancy.counts().blocks().size());
  }
  perScan(state, recorded().key_nodes.size());
}

/** A loop closure moves a tenth of the key nodes, and the next one moves them back. */
void lampATenthMoves(benchmark::State& state) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  ComponentMap moved = recorded();
  for (size_t i = 0; i < moved.key_nodes.size() / 10; ++i)
    moved.key_nodes[i].world_T_base.pretranslate(Eigen::Vector3d(0.3, 0.1, 0));
  OccupancyMap occupancy({kVoxel, kRange, 0});
  occupancy.update(recorded());
  bool there = false;
  for (auto _ : state) {
    there = !there;
    occupancy.update(there ? moved : recorded());
  }
}

void mrptFromNothing(benchmark::State& state) {
  const ComponentMap& map = recorded();
  std::vector<mrpt::obs::CObservationPointCloud> observations;
  for (const MapKeyNode& key_node : map.key_nodes) {
    auto points = mrpt::maps::CSimplePointsMap::Create();
    for (const Eigen::Vector3f& p : key_node.scan->points)
      points->insertPoint(p.x(), p.y(), p.z() - 0.8f);
    mrpt::obs::CObservationPointCloud observation;
    observation.pointcloud = points;
    observation.sensorPose = mrpt::poses::CPose3D(0, 0, 0.8, 0, 0, 0);
    observations.push_back(observation);
  }
  for (auto _ : state) {
    mrpt::maps::COctoMap octomap(kVoxel);
    octomap.insertionOptions.maxrange = kRange;
    for (size_t i = 0; i < observations.size(); ++i)
      octomap.insertObservation(observations[i], mrpt::poses::CPose3D(mrpt::math::CMatrixDouble44(
                                                     map.key_nodes[i].world_T_base.matrix())));
  }
  perScan(state, observations.size());
}

BENCHMARK(lampFromNothing)->Unit(benchmark::kMillisecond);
BENCHMARK(lampATenthMoves)->Unit(benchmark::kMillisecond);
BENCHMARK(mrptFromNothing)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamp
