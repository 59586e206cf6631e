// Rays per second of the simulator: of the ray caster alone, and of whole sweeps of a lidar, which
// also move the sensor, add noise and dust, and weaken the light. One thread.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>

#include "lamp/simulation/Drive.h"
#include "lamp/simulation/Lidar.h"
#include "lamp/simulation/World.h"

namespace lamp::simulation {
namespace {

/** A world for 300 m of ways, and a robot that drives in it. */
struct Place {
  explicit Place(const WorldKind& kind)
      : world(kind.make(300, kind.cell_m, 1)),
        caster(world.mesh),
        truth(drive(planRoutes(world.layout, {100}, 1)[0], caster, DriveOptions(), 0, 1)) {}

  static const Place& of(const std::string& kind) {
    static std::map<std::string, std::unique_ptr<Place>> made;
    auto& found = made[kind];
    if (!found) found = std::make_unique<Place>(worldKind(kind));
    return *found;
  }

  World world;
  RayCaster caster;
  TrajectoryInterpolator truth;
};

/** The directions in which a spinning lidar fires, from ten places on the way. */
void castRays(benchmark::State& state, const std::string& kind) {
  const Place& place = Place::of(kind);
  const FiringPattern pattern(900, 10, 1);
  int64_t rays = 0, hits = 0;
  for (auto _ : state) {
    const double stamp = place.truth.begin() + 8.0 * static_cast<double>(rays / 14400 % 10);
    const Eigen::Isometry3f pose = place.truth.at(stamp).cast<float>();
    const Eigen::Vector3f eye = pose * Eigen::Vector3f(0, 0, 0.8f);
    for (int sequence = 0; sequence < 900; ++sequence)
      for (int laser = 0; laser < 16; ++laser)
        hits += place.caster.cast(eye, pose.linear() * pattern.direction(sequence, laser), 100)
                    .has_value();
    rays += 14400;
  }
  benchmark::DoNotOptimize(hits);
  state.SetItemsProcessed(rays);
  state.counters["triangles"] = static_cast<double>(place.world.mesh.triangles.size());
}

void sweep(benchmark::State& state, const std::string& kind) {
  const Place& place = Place::of(kind);
  const Lidar lidar({}, place.caster);
  int64_t sweeps = 0;
  size_t returns = 0;
  for (auto _ : state) {
    const double stamp = place.truth.begin() + 8.0 * static_cast<double>(sweeps++ % 10);
    returns += lidar.sweep(place.truth, stamp, 1).returns.size();
  }
  state.SetItemsProcessed(sweeps * lidar.options().azimuth_steps * 16);
  state.counters["returns_per_sweep"] = static_cast<double>(returns) / static_cast<double>(sweeps);
}

BENCHMARK_CAPTURE(castRays, tunnel, "tunnel");
BENCHMARK_CAPTURE(castRays, ku, "ku");
BENCHMARK_CAPTURE(sweep, tunnel, "tunnel")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(sweep, ku, "ku")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamp::simulation
