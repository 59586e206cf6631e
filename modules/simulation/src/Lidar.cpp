#include "lamp/simulation/Lidar.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "Dust.h"
#include "MoversNear.h"
#include "Reflectance.h"
#include "SensorPath.h"

namespace lamp::simulation {
namespace {

constexpr double kRadians = M_PI / 180.0;

LidarOptions checked(LidarOptions options) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw std::runtime_error(std::string("lidar: ") + what);
  };
  require(options.model == "spinning" || options.model == "rotating_mount",
          "model must be 'spinning' or 'rotating_mount'");
  require(options.pose.size() == 6, "pose must be [x y z yaw_deg pitch_deg roll_deg]");
  require(options.rate_hz > 0 && options.azimuth_steps > 0, "rate and steps must be positive");
  require(options.azimuth_steps <= 65535, "there are at most 65535 azimuth steps");
  require(options.max_range_m > options.min_range_m, "max_range_m must exceed min_range_m");
  require(options.grazing_deg < 90, "grazing_deg must be below 90");
  require(options.sequences_per_block == 1 || options.sequences_per_block == 2,
          "a block holds one or two firing sequences");
  require(options.packets_per_observation > 0, "packets_per_observation must be positive");
  require(options.dust_patch_s > 0, "dust_patch_s must be positive");
  return options;
}

Pose3 poseFromDegrees(const std::vector<double>& v) {
  Vector6d radians = Eigen::Map<const Vector6d>(v.data());
  radians.tail<3>() *= kRadians;
  return poseFromYawPitchRoll(radians);
}

uint64_t bitsOf(double value) {
  uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

struct Lidar::Ray {
  Eigen::Vector3f origin;            ///< world
  Eigen::Vector3f direction;         ///< world
  Eigen::Vector3f sensor_direction;  ///< sensor frame
};

/** What a ray meets first. */
struct Lidar::Target {
  LitSurface surface;
  uint32_t triangle = LidarReturn::kNoTriangle;  ///< none of a mover
  bool moves = false;
};

Lidar::Lidar(LidarOptions options, const RayCaster& caster, Movers movers)
    : options_(checked(std::move(options))),
      caster_(caster),
      movers_(std::move(movers)),
      pattern_(options_.azimuth_steps, options_.rate_hz, options_.sequences_per_block),
      base_T_mount_(poseFromDegrees(options_.pose)) {}

Pose3 Lidar::baseTSensor(double stamp) const {
  if (!rotates()) return base_T_mount_;
  double turns = stamp * options_.mount_rate_hz;
  turns -= std::floor(turns);
  return base_T_mount_ * Eigen::AngleAxisd(2.0 * M_PI * turns, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(options_.mount_tilt_deg * kRadians, Eigen::Vector3d::UnitX());
}

LidarSweep Lidar::sweep(const TrajectoryInterpolator& truth, double begin_stamp,
                        uint64_t seed) const {
  LidarSweep sweep{begin_stamp, pattern_.duration(), {}};
  Random random(mixSeeds({seed, bitsOf(begin_stamp)}));
  const double dust_per_m = dustPerMetre(options_, begin_stamp, seed);
  const SensorPath world_T_sensor(
      [&](double stamp) { return Pose3(truth.at(stamp) * baseTSensor(stamp)); }, begin_stamp,
      sweep.duration_s);
  static const std::vector<Mover> kNone;
  MoversNear movers(movers_ ? *movers_ : kNone, truth.at(begin_stamp).translation(),
                    options_.max_range_m, begin_stamp, sweep.duration_s);
  sweep.returns.reserve(static_cast<size_t>(pattern_.sequences()) * FiringPattern::kLasers);
  for (int sequence = 0; sequence < pattern_.sequences(); ++sequence) {
    // One pose for the 16 lasers, which fire within 35 us.
    const double middle = pattern_.delay(sequence, FiringPattern::kLasers / 2);
    const auto pose = world_T_sensor.at(middle);
    movers.moveTo(middle);
    for (int laser = 0; laser < FiringPattern::kLasers; ++laser) {
      const Eigen::Vector3f direction = pattern_.direction(sequence, laser);
      const Ray ray{pose.translation(), pose.linear() * direction, direction};
      LidarReturn result;
      if (!measure(ray, targetOf(ray, movers), dust_per_m, random, result)) continue;
      result.stamp = begin_stamp + pattern_.delay(sequence, laser);
      result.sequence = static_cast<uint16_t>(sequence);
      result.laser = static_cast<uint8_t>(laser);
      sweep.returns.push_back(result);
    }
  }
  return sweep;
}

std::optional<Lidar::Target> Lidar::targetOf(const Ray& ray, const MoversNear& movers) const {
  const auto max_range = static_cast<float>(options_.max_range_m);
  const auto hit = caster_.cast(ray.origin, ray.direction, max_range);
  const auto mover = movers.cast(ray.origin, ray.direction, hit ? hit->range_m : max_range);
  if (!hit && !mover) return std::nullopt;
  Target target;
  LitSurface& surface = target.surface;
  surface.range_m = mover ? mover->range_m : hit->range_m;
  surface.material = mover ? mover->material : caster_.mesh().materials[hit->triangle];
  surface.albedo = albedoOf(surface.material, ray.origin + surface.range_m * ray.direction);
  surface.cos_incidence = mover ? mover->cos_incidence
                                : std::abs(caster_.mesh().normal(hit->triangle).dot(ray.direction));
  target.moves = mover.has_value();
  if (!mover) target.triangle = hit->triangle;
  return target;
}

/** \return false if no light comes back. */
bool Lidar::measure(const Ray& ray, const std::optional<Target>& target, double dust_per_m,
                    Random& random, LidarReturn& result) const {
  const double surface_m = target ? target->surface.range_m : options_.max_range_m;
  double dust_m = surface_m;
  if (dust_per_m > 0) dust_m = std::exponential_distribution<double>(dust_per_m)(random);
  if (dust_m < surface_m && dust_m >= options_.min_range_m) {
    result.range_m = static_cast<float>(dust_m);
    result.intensity = static_cast<float>(uniform(random, 0.005, 0.04));
  } else if (!target || !measureSurface(*target, random, result)) {
    return false;
  }
  result.point = result.range_m * ray.sensor_direction;
  return true;
}

bool Lidar::measureSurface(const Target& target, Random& random, LidarReturn& result) const {
  const LitSurface& surface = target.surface;
  const double returns =
      returnProbability(surface, static_cast<float>(std::cos(options_.grazing_deg * kRadians)),
                        static_cast<float>(options_.max_range_m));
  if (!chance(random, returns * (1.0 - options_.dropout))) return false;
  const double range = surface.range_m + lamp::simulation::normal(random, options_.range_sigma_m);
  const double intensity =
      intensityOf(surface) + lamp::simulation::normal(random, options_.intensity_sigma);
  if (range < options_.min_range_m || range > options_.max_range_m) return false;
  result.range_m = static_cast<float>(range);
  result.intensity = static_cast<float>(std::clamp(intensity, 1.0 / 255.0, 1.0));
  result.triangle = target.triangle;
  result.moves = target.moves;
  return true;
}

std::vector<Eigen::Vector3f> deskew(const LidarSweep& sweep, const Lidar& lidar,
                                    const TrajectoryInterpolator& trajectory, double stamp) {
  const Pose3 base_T_frame = trajectory.at(stamp).inverse();
  const SensorPath base_T_sensor(
      [&](double t) { return Pose3(base_T_frame * trajectory.at(t) * lidar.baseTSensor(t)); },
      sweep.begin_stamp, sweep.duration_s);
  std::vector<Eigen::Vector3f> points;
  points.reserve(sweep.returns.size());
  for (const LidarReturn& r : sweep.returns)
    points.push_back(base_T_sensor.at(r.stamp - sweep.begin_stamp) * r.point);
  return points;
}

}  // namespace lamp::simulation
