#include "lamp/simulation/SimConfig.h"

#include <algorithm>
#include <iterator>

namespace lamp::simulation {

namespace {

constexpr int kMaxRobots = 16;
const std::string kLidarPrefix = "lidar.";
const char* const kRobotPrefixes[] = {"robot.", "drive.", "odometry."};

/** The lidars of the paper's robots (III, "Hardware Setup"). */
std::map<std::string, LidarOptions> paperLidars() {
  std::map<std::string, LidarOptions> lidars;
  lidars["top"].pose = {0.1, 0, 0.8, 0, 0, 0};
  lidars["front"].pose = {0.4, 0, 0.6, 0, 35, 0};
  lidars["rear"].pose = {-0.4, 0, 0.6, 180, 35, 0};
  LidarOptions& hovermap = lidars["hovermap"];
  hovermap.model = "rotating_mount";
  hovermap.pose = {0, 0, 0.7, 0, 0, 0};
  return lidars;
}

std::vector<SimulatedRobotOptions> paperTeam(const WorldKind& kind, const WorldOptions& world) {
  const size_t known = kind.robots.size();
  const size_t count = world.robots > 0 ? static_cast<size_t>(world.robots) : known;
  std::vector<SimulatedRobotOptions> team;
  for (size_t i = 0; i < count; ++i) {
    const PaperRobot& paper = kind.robots[i % known];
    SimulatedRobotOptions robot;
    robot.name = paper.name + (i < known ? "" : "_" + std::to_string(i / known + 1));
    robot.length_m = paper.length_m * world.distance_scale;
    robot.lidars = paper.lidars;
    robot.odometry.min_ate_m = paper.lamp1_ate_m * world.distance_scale;
    team.push_back(robot);
  }
  return team;
}

/** Reads `[kind]`, then `[kind.NAME]` over it. */
template <class Options>
void readBoth(const Ini& ini, const std::string& kind, const std::string& name, Options& options,
              Faults& faults) {
  Faults reported_once;
  readOptions(ini.find(kind), options, reported_once);
  readOptions(ini.find(kind + "." + name), options, faults);
}

bool hasPrefix(const std::string& text, const std::string& prefix) {
  return text.rfind(prefix, 0) == 0;
}

/** Sections that nothing reads are faults. \param team_known whether the robots' are known. */
void checkSections(const Ini& ini, const SimConfig& config, bool team_known, Faults& faults) {
  std::vector<std::string> known = {"world", "keyed",    "imu",       "radio", "link",
                                    "drive", "odometry", "artifacts", "movers"};
  for (const SimulatedRobotOptions& robot : config.robots)
    for (const char* const kind : kRobotPrefixes) known.push_back(kind + robot.name);
  for (const Ini::Section& section : ini.sections()) {
    const bool of_robot =
        std::any_of(std::begin(kRobotPrefixes), std::end(kRobotPrefixes),
                    [&](const char* prefix) { return hasPrefix(section.name, prefix); });
    if (hasPrefix(section.name, kLidarPrefix) || (of_robot && !team_known)) continue;
    if (std::find(known.begin(), known.end(), section.name) == known.end())
      faults.add(section.where,
                 "there is no section [" + section.name + "]" + didYouMean(section.name, known));
  }
}

}  // namespace

void WorldOptions::visit(OptionVisitor& v) {
  v("robots", robots, "", "size of the team; 0 for the paper's", {0, kMaxRobots});
  v("distance_scale", distance_scale, "", "factor of the paper's distances, and so of the world",
    {0.05, 20});
  v("cell_m", cell_m, "m", "size of the walls' triangles; 0 for what suits the world", {0, 1});
  v("start_interval_s", start_interval_s, "s", "robots leave the gate one after the other",
    kNotNegative);
  v("truth_spacing_m", truth_spacing_m, "m",
    "distance of the samples in truth/map.ply; 0 for 0.6 cells", {0, 1});
  v("loop_pairs", loop_pairs, "", "true, and as many false, pairs of scans in truth/loop_pairs.csv",
    kNotNegative);
}

void KeyedOptions::visit(OptionVisitor& v) {
  v("key_node_distance_m", key_node_distance_m, "m",
    "distance travelled before a new key node is added; smaller values give more loop closures and "
    "take more time",
    kPositive);
  v("key_node_angle_deg", key_node_angle_deg, "deg", "rotation before a new key node is added",
    kPositive);
  v("max_points", max_points, "", "points of a keyed scan at most", {10, 5000});
  v("rotation_s", rotation_s, "s", "time over which the sweeps of a rotating mount are merged",
    kPositive);
}

void SimulatedRobotOptions::visit(OptionVisitor& v) {
  v("length_m", length_m, "m", "way that the robot drives", {5, 1e5});
  v("lidars", lidars, "names of its [lidar.NAME] sections");
}

SimConfig::SimConfig(const WorldKind& world_kind, const Ini& ini, Faults faults)
    : kind(&world_kind), lidars(paperLidars()) {
  const size_t faults_before = faults.list().size();
  readOptions(ini.find("world"), world, faults);
  // The size of the team decides which robots' sections there are.
  const bool team_known = faults.list().size() == faults_before;
  readOptions(ini.find("keyed"), keyed, faults);
  readOptions(ini.find("imu"), imu, faults);
  readOptions(ini.find("radio"), radio, faults);
  readOptions(ini.find("link"), link, faults);
  readOptions(ini.find("artifacts"), artifacts, faults);
  readOptions(ini.find("movers"), movers, faults);
  for (const Ini::Section& section : ini.sections())
    if (hasPrefix(section.name, kLidarPrefix))
      readOptions(&section, lidars[section.name.substr(kLidarPrefix.size())], faults);
  DriveOptions drive;
  OdometryOptions odometry;
  readOptions(ini.find("drive"), drive, faults);
  readOptions(ini.find("odometry"), odometry, faults);
  robots = paperTeam(*kind, world);
  for (SimulatedRobotOptions& robot : robots) {
    readOptions(ini.find("robot." + robot.name), robot, faults);
    readBoth(ini, "drive", robot.name, robot.drive, faults);
    readBoth(ini, "odometry", robot.name, robot.odometry, faults);
    if (robot.lidars.empty()) faults.add("[robot." + robot.name + "]", "lidars must name one");
    for (const std::string& lidar : robot.lidars)
      if (lidars.count(lidar) == 0)
        faults.add("[robot." + robot.name + "] lidars",
                   "there is no section [" + kLidarPrefix + lidar + "]");
  }
  checkSections(ini, *this, team_known, faults);
  faults.throwIfAny();
}

std::string SimConfig::text() const {
  SimConfig copy = *this;  // visit() takes options that it may change
  std::string text = writeOptions("world", copy.world) + "\n" + writeOptions("keyed", copy.keyed) +
                     "\n" + writeOptions("imu", copy.imu) + "\n" +
                     writeOptions("radio", copy.radio) + "\n" + writeOptions("link", copy.link) +
                     "\n" + writeOptions("artifacts", copy.artifacts) + "\n" +
                     writeOptions("movers", copy.movers);
  for (auto& [name, lidar] : copy.lidars) text += "\n" + writeOptions(kLidarPrefix + name, lidar);
  for (SimulatedRobotOptions& robot : copy.robots) {
    text += "\n" + writeOptions("robot." + robot.name, robot);
    text += "\n" + writeOptions("drive." + robot.name, robot.drive);
    text += "\n" + writeOptions("odometry." + robot.name, robot.odometry);
  }
  return text;
}

double SimConfig::totalLength() const {
  double sum = 0;
  for (const SimulatedRobotOptions& robot : robots) sum += robot.length_m;
  return sum;
}

double SimConfig::truthSpacingM() const {
  return world.truth_spacing_m > 0 ? world.truth_spacing_m : 0.6 * cellM();
}

}  // namespace lamp::simulation
