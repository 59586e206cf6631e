#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Trajectory.h"
#include "lamp/simulation/FiringPattern.h"
#include "lamp/simulation/Movers.h"
#include "lamp/simulation/Random.h"
#include "lamp/simulation/RayCaster.h"

namespace lamp::simulation {

class MoversNear;

struct LidarOptions {
  std::string model = "spinning";
  std::vector<double> pose = {0, 0, 0.5, 0, 0, 0};
  double rate_hz = 10;
  int azimuth_steps = 900;
  int sequences_per_block = 1;
  double range_sigma_m = 0.02;
  double min_range_m = 0.5;
  double max_range_m = 100;
  double dropout = 0.01;
  double grazing_deg = 80;
  double intensity_sigma = 0.015;
  double dust_per_m = 0.005;
  double dust_share = 0.1;
  double dust_patch_s = 10;
  double mount_rate_hz = 0.5;
  double mount_tilt_deg = 80;
  int packets_per_observation = 2;

  void visit(OptionVisitor& v);
};

struct LidarReturn {
  /** `triangle` of what comes from dust, or from what moves. */
  static constexpr uint32_t kNoTriangle = std::numeric_limits<uint32_t>::max();

  double stamp = 0;  ///< seconds, UTC, of the firing
  uint16_t sequence = 0;
  uint8_t laser = 0;
  float range_m = 0;
  float intensity = 0;    ///< 0 to 1; diffuse surfaces stay below 0.4, reflectors are above 0.6
  Eigen::Vector3f point;  ///< sensor frame at the stamp, metres
  uint32_t triangle = kNoTriangle;  ///< of the mesh
  bool moves = false;               ///< from a mover

  bool fromDust() const { return triangle == kNoTriangle && !moves; }
};

/** One revolution, in the order of firing. */
struct LidarSweep {
  double begin_stamp = 0;
  double duration_s = 0;
  std::vector<LidarReturn> returns;
};

/** A lidar on a robot in a world. Each firing starts where the sensor truly is at that time, so
 * sweeps of a moving robot are distorted as real ones are.
 *
 * A `rotating_mount` turns the whole lidar about the z axis of `pose`, as handheld and drone
 * mappers do to see all around: base_T_sensor changes with time.
 */
class Lidar {
 public:
  using Movers = std::shared_ptr<const std::vector<Mover>>;

  /** \param caster must outlive the lidar. \param movers what else is there; null for nothing.
   *  \throws std::runtime_error for options out of range. */
  Lidar(LidarOptions options, const RayCaster& caster, Movers movers = nullptr);

  const LidarOptions& options() const { return options_; }
  const FiringPattern& pattern() const { return pattern_; }
  bool rotates() const { return options_.model == "rotating_mount"; }
  Pose3 baseTSensor(double stamp) const;

  /** \param truth `world_T_base`. \param seed of this lidar; the stamp tells its sweeps apart. */
  LidarSweep sweep(const TrajectoryInterpolator& truth, double begin_stamp, uint64_t seed) const;

 private:
  struct Ray;
  struct Target;
  std::optional<Target> targetOf(const Ray& ray, const MoversNear& movers) const;
  bool measure(const Ray& ray, const std::optional<Target>& target, double dust_per_m,
               Random& random, LidarReturn& result) const;
  bool measureSurface(const Target& target, Random& random, LidarReturn& result) const;

  LidarOptions options_;
  const RayCaster& caster_;
  Movers movers_;
  FiringPattern pattern_;
  Pose3 base_T_mount_;
};

/** The points of a sweep in the base frame at one stamp, as a robot that moved along `trajectory`
 * would have seen them: straight with the truth, nearly so with odometry.
 * \param trajectory `anything_T_base` at least over the time of the sweep. */
std::vector<Eigen::Vector3f> deskew(const LidarSweep& sweep, const Lidar& lidar,
                                    const TrajectoryInterpolator& trajectory, double stamp);

}  // namespace lamp::simulation
