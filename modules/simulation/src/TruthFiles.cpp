#include "lamp/simulation/TruthFiles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "lamp/core/CloudHeader.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"

namespace lamp::simulation {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/** Even samples of a triangle: a grid in two of its sides, no wider than the spacing. */
template <class Visit>
void sampleTriangle(const Mesh& mesh, size_t triangle, double spacing_m, Visit visit) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Eigen::Vector3f origin = mesh.vertices[a], u = mesh.vertices[b] - origin,
                        v = mesh.vertices[c] - origin;
  // For the two equal sides of a right triangle of this area, as most are.
  const double side = std::sqrt(u.cross(v).norm());
  const int steps = std::max(1, static_cast<int>(std::ceil(side / spacing_m)));
  for (int i = 0; i < steps; ++i)
    for (int k = 0; i + k < steps; ++k) {
      // The middle of the small triangle, so that neighbours do not share samples.
      const float s = (static_cast<float>(i) + 1.0f / 3.0f) / static_cast<float>(steps);
      const float t = (static_cast<float>(k) + 1.0f / 3.0f) / static_cast<float>(steps);
      visit(Eigen::Vector3f(origin + s * u + t * v));
    }
}

}  // namespace

size_t writeTruthMap(const std::string& path, const Mesh& mesh, const SeenTriangles& seen,
                     double spacing_m) {
  std::string body;
  size_t count = 0;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Eigen::Vector3f normal = mesh.normal(i);
    if (normal.isZero()) continue;
    sampleTriangle(mesh, i, spacing_m, [&](const Eigen::Vector3f& point) {
      appendBytes(point, body);
      appendBytes(normal, body);
      body.push_back(seen[i] ? 1 : 0);
      ++count;
    });
  }
  const CloudLayout layout{
      {"mrpt-lamp: the true surface"},
      {{"x"}, {"y"}, {"z"}, {"nx"}, {"ny"}, {"nz"}, {"seen", CloudScalar::kUint8}},
      count};
  writeTextFile(path, plyHeader(layout) + body);
  return count;
}

std::string worldJson(const World& world, const Mission& mission, const std::string& kind,
                      uint64_t seed) {
  Json json;
  json["world"] = kind;
  json["seed"] = seed;
  const Vector6d gate = yawPitchRollFromPose(world.world_T_gate);
  json["gate"]["position_m"] = toJson(gate.head<3>());
  json["gate"]["yaw_deg"] = gate[3] * 180.0 / M_PI;
  for (const Eigen::Vector3d& plate : world.plates)
    json["gate"]["plates_m"].push_back(toJson(plate));
  for (const MissionRobot& robot : mission.robots) {
    const Vector6d start = yawPitchRollFromPose(robot.truth.at(robot.truth.begin()));
    json["robots"].push_back({{"name", robot.name},
                              {"start_position_m", toJson(start.head<3>())},
                              {"start_yaw_pitch_roll_deg", toJson(start.tail<3>() * 180.0 / M_PI)},
                              {"key_nodes", robot.key_nodes.size()},
                              {"odometry_ate_m", robot.odometry.ate_m},
                              {"odometry_error_scale", robot.odometry.error_scale}});
  }
  json["beacons"] = Json::array();
  for (const Beacon& beacon : mission.beacons)
    json["beacons"].push_back(
        {{"name", beacon.name}, {"position_m", toJson(beacon.position)}, {"since", beacon.since}});
  json["artifacts"] = Json::array();
  for (const Artifact& artifact : world.artifacts)
    json["artifacts"].push_back(
        {{"id", artifact.id}, {"kind", artifact.kind}, {"position_m", toJson(artifact.position)}});
  return json.dump(2) + "\n";
}

std::string loopPairsCsv(const std::vector<LoopPair>& pairs, const Mission& mission) {
  CsvTable table{{"from", "to", "from_stamp", "to_stamp", "x", "y", "z", "qx", "qy", "qz", "qw",
                  "overlap", "pair", "look_alike"},
                 {}};
  const auto name = [&](KeyNodeId id) {
    return mission.robots[id.robot.value].name + ":" + std::to_string(id.index);
  };
  for (const LoopPair& pair : pairs) {
    std::vector<std::string> row = {name(pair.from), name(pair.to), formatFixed(pair.from_stamp, 6),
                                    formatFixed(pair.to_stamp, 6)};
    const Eigen::Vector3d t = pair.from_T_to.translation();
    const Eigen::Quaterniond q(pair.from_T_to.linear());
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
      row.push_back(formatFixed(value, 9));
    row.push_back(formatFixed(pair.overlap, 4));
    row.push_back(pair.same_place ? "true" : "false");
    row.push_back(pair.look_alike ? "1" : "0");
    table.rows.push_back(std::move(row));
  }
  return table.text();
}

std::string truthTum(const MissionRobot& robot) {
  std::vector<StampedPose> poses;
  for (const double stamp : robot.scanStamps()) poses.push_back({stamp, robot.truth.at(stamp)});
  return toTum(poses);
}

std::string moversPly(const MovingPoints& moving) {
  std::string body;
  size_t count = 0;
  for (const auto& [scan, points] : moving)
    for (const Eigen::Vector3f& point : points) {
      appendBytes(static_cast<float>(scan), body);
      appendBytes(point, body);
      ++count;
    }
  const CloudLayout layout{
      {"mrpt-lamp: returns from people and vehicles"}, {{"scan"}, {"x"}, {"y"}, {"z"}}, count};
  return plyHeader(layout) + body;
}

std::string arrivalsCsv(const MissionRobot& robot) {
  CsvTable table{{"stamp", "arrival"}, {}};
  for (size_t i = 0; i < robot.key_nodes.size(); ++i)
    table.rows.push_back({formatFixed(robot.stampOf(i), 6), formatFixed(robot.arrivals[i], 6)});
  return table.text();
}

std::string slamIni(const World& world, const Mission& mission, bool keyed) {
  std::string text =
      "// Made by lamp-sim:  lamp-slam THIS_FILE --out RUN  and then  lamp-eval RUN --truth "
      "truth\n";
  if (keyed) text += "\n[frontend]\nkeyed = true\n";
  text += "\n[gate]\nplates = [";
  for (const Eigen::Vector3d& plate : world.plates)
    for (int i = 0; i < 3; ++i) text += (text.back() == '[' ? "" : " ") + formatFixed(plate[i], 6);
  text += "]\n";
  for (const MissionRobot& robot : mission.robots) {
    Vector6d start = yawPitchRollFromPose(robot.truth.at(robot.truth.begin()));
    start.tail<3>() *= 180.0 / M_PI;
    text += "\n[robot." + robot.name + "]\nrawlog = " + robot.name +
            ".rawlog\narrivals = " + robot.name + ".arrivals.csv\nstart_pose = [";
    for (int i = 0; i < 6; ++i) text += (i ? " " : "") + formatFixed(start[i], 6);
    text += "]\n";
    // The calibration gate's, which the team passed (paper II-B).
    text += "start_sigma_xyz_m = 0.05\nstart_sigma_rot_deg = 0.1\n";
  }
  return text;
}

}  // namespace lamp::simulation
