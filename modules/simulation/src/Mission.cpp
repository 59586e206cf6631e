#include "lamp/simulation/Mission.h"

#include <algorithm>
#include <cmath>

namespace lamp::simulation {

namespace {

/** All missions begin at the same time. */
constexpr double kBeginStamp = 1600000000.0;

MissionRobot makeRobot(const SimConfig& config, const SimulatedRobotOptions& options,
                       const RayCaster& caster, TrajectoryInterpolator truth,
                       const Lidar::Movers& movers, uint64_t seed) {
  MissionRobot robot{options.name, seed, std::move(truth), {}, 0, {}, {}, options.lidars, {}, {},
                     {},           {}};
  for (const std::string& name : options.lidars)
    robot.lidars.emplace_back(config.lidars.at(name), caster, movers);
  OdometryOptions odometry = options.odometry;
  odometry.rate_hz = config.lidars.at(options.lidars.front()).rate_hz;
  robot.odometry = simulateOdometry(robot.truth, odometry, mixSeeds({seed, 2}));
  // Scans are those whose sweeps end before the truth does.
  const double last = robot.truth.end() - 1.0 / odometry.rate_hz;
  const std::vector<StampedPose>& poses = robot.odometry.odom_T_base;
  robot.scans = poses.size();
  while (robot.scans > 1 && poses[robot.scans - 1].stamp > last) --robot.scans;
  robot.key_nodes = selectKeyNodes(
      {poses.begin(), poses.begin() + static_cast<ptrdiff_t>(robot.scans)}, config.keyed);
  robot.imu = simulateImu(robot.truth, config.imu, mixSeeds({seed, 3}));
  return robot;
}

std::vector<double> keyStamps(const MissionRobot& robot) {
  std::vector<double> stamps;
  for (size_t i = 0; i < robot.key_nodes.size(); ++i) stamps.push_back(robot.stampOf(i));
  return stamps;
}

}  // namespace

std::vector<double> MissionRobot::scanStamps() const {
  std::vector<double> stamps;
  for (size_t i = 0; i < scans; ++i) stamps.push_back(odometry.odom_T_base[i].stamp);
  return stamps;
}

std::vector<size_t> selectKeyNodes(const std::vector<StampedPose>& odom_T_base,
                                   const KeyedOptions& options) {
  std::vector<size_t> selected;
  for (size_t i = 0; i < odom_T_base.size(); ++i) {
    if (!selected.empty()) {
      const Pose3 motion = odom_T_base[selected.back()].pose.inverse() * odom_T_base[i].pose;
      if (motion.translation().norm() < options.key_node_distance_m &&
          rotationAngle(motion) * 180.0 / M_PI < options.key_node_angle_deg)
        continue;
    }
    selected.push_back(i);
  }
  return selected;
}

Mission makeMission(const SimConfig& config, const World& world, const RayCaster& caster,
                    uint64_t seed) {
  std::vector<double> lengths;
  for (const SimulatedRobotOptions& robot : config.robots) lengths.push_back(robot.length_m);
  const auto routes = planRoutes(world.layout, lengths, mixSeeds({seed, 1}));

  const auto robotSeed = [&](size_t i) { return mixSeeds({seed, 2, i}); };
  std::vector<TrajectoryInterpolator> ways;
  double recovered = kBeginStamp;
  for (size_t i = 0; i < routes.size(); ++i) {
    const double start = kBeginStamp + config.world.start_interval_s * static_cast<double>(i);
    ways.emplace_back(
        drive(routes[i], caster, config.robots[i].drive, start, mixSeeds({robotSeed(i), 1})));
    recovered = std::max(recovered, ways.back().end());
  }

  Mission mission;
  if (config.movers.people + config.movers.vehicles > 0)
    mission.movers = std::make_shared<const std::vector<Mover>>(makeMovers(
        config.movers, world.layout, caster, {kBeginStamp, recovered}, mixSeeds({seed, 3})));
  for (size_t i = 0; i < routes.size(); ++i) {
    mission.robots.push_back(makeRobot(config, config.robots[i], caster, std::move(ways[i]),
                                       mission.movers, robotSeed(i)));
    const MissionRobot& robot = mission.robots.back();
    for (const Beacon& beacon : dropBeacons(robot.truth, robot.name, config.radio.beacon_spacing_m))
      mission.beacons.push_back(beacon);
  }
  const Radio radio(config.radio, caster);
  const Link link(config.link, caster, world.world_T_gate.translation(), mission.beacons);
  for (MissionRobot& robot : mission.robots) {
    robot.rssi = radio.listen(robot.truth, mission.beacons, mixSeeds({robot.seed, 4}));
    robot.sightings = seeArtifacts(world.artifacts, robot.truth, caster, config.artifacts,
                                   mixSeeds({robot.seed, 5}));
    robot.arrivals = link.arrivalTimes(keyStamps(robot), robot.truth, recovered);
  }
  return mission;
}

}  // namespace lamp::simulation
