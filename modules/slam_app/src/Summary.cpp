#include "Summary.h"

#include <mrpt/version.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "WorldFrame.h"
#include "lamp/core/Version.h"

namespace lamp {

namespace {

using Json = nlohmann::ordered_json;

double length(const std::vector<StampedPose>& trajectory) {
  double sum = 0;
  for (size_t i = 1; i < trajectory.size(); ++i)
    sum += (trajectory[i].pose.translation() - trajectory[i - 1].pose.translation()).norm();
  return sum;
}

/** A letter or digit as such, any other byte as its number. */
std::string keyText(char key) {
  const auto byte = static_cast<unsigned char>(key);
  return std::isalnum(byte) ? std::string(1, key) : std::to_string(byte);
}

Json robotSummary(const RunResult& result, RobotId robot) {
  const BaseStation& base = result.base_station;
  const auto& nodes = base.graph().robotNodes(robot);
  Json json;
  json["name"] = result.robots.name(robot);
  json["key"] = keyText(result.robots.letter(robot));
  json["key_nodes"] = nodes.size();
  json["planar"] = !nodes.empty() && base.graph().node(nodes.front()).planar;
  json["start_pose_known"] =
      !nodes.empty() && base.tracks().packets().at(nodes.front()).prior.has_value();
  json["odometry_length_m"] = length(base.tracks().odometryTrajectory(robot));
  json["optimized_length_m"] = length(base.tracks().trajectory(base.graph(), robot));
  json["scans"] = 0;
  json["warnings"] = Json::array();
  for (const FrontEndReport& report : result.reports) {
    if (report.robot != robot) continue;
    json["scans"] = report.counts.scans;
    json["scans_without_odometry"] = report.counts.without_odometry;
    json["scans_tracked"] = report.counts.tracked_scans;
    json["empty_scans"] = report.counts.empty_scans;
    json["warnings"] = report.warnings;
  }
  return json;
}

Json componentSummary(const RunResult& result, const Component& component, size_t rank) {
  const ComponentLoops loops = countLoops(result.base_station.graph(), component);
  Json json;
  json["map"] = RunFolder("").mapStem(rank).substr(1);
  const Eigen::Vector3d origin =
      originOf(component, result.base_station.graph(), result.world_p_origin);
  json["map_offset_m"] = {origin.x(), origin.y(), origin.z()};
  json["robots"] = Json::array();
  for (const RobotId robot : component.robots) json["robots"].push_back(result.robots.name(robot));
  json["key_nodes"] = component.nodes.size();
  json["inliers_within_robots"] = loops.within_robots;
  json["inliers_between_robots"] = loops.between_robots;
  json["anchor"] = result.robots.format(component.nodes.front());
  return json;
}

/** `[x y z yaw pitch roll]`, metres and degrees. */
Json poseSummary(const Pose3& pose) {
  Vector6d numbers = yawPitchRollFromPose(pose);
  numbers.tail<3>() *= 180.0 / M_PI;
  return std::vector<double>(numbers.data(), numbers.data() + numbers.size());
}

Json frameSummary(const RunResult& result, const FrameAgreement& frames) {
  Json equally_good = Json::array();
  for (const Pose3& placement : frames.equally_good) equally_good.push_back(poseSummary(placement));
  return {{"robots", {result.robots.name(frames.a), result.robots.name(frames.b)}},
          {"loops", frames.loops},
          {"agreeing", frames.agreeing},
          {"needed", frames.needed},
          {"joined", frames.joined},
          {"equally_good", equally_good},
          {"contradicting", frames.contradicting}};
}

/** By type: edges other than odometry, priors and loop closures, and how many are kept. */
Json measurementSummary(const PoseGraph& graph) {
  Json json = Json::object();
  for (const Edge& edge : graph.edges()) {
    if (edge.joinsPoses() || edge.type == EdgeType::kPrior) continue;
    Json& of_type = json[toString(edge.type)];
    if (of_type.is_null()) of_type = {{"edges", 0}, {"inliers", 0}};
    of_type["edges"] = of_type["edges"].get<size_t>() + 1;
    if (edge.verdict == Verdict::kInlier) of_type["inliers"] = of_type["inliers"].get<size_t>() + 1;
  }
  return json;
}

Json optimizationSummary(const RunResult& result) {
  const BaseStation& base = result.base_station;
  Json json;
  json["optimizations"] = base.optimizations();
  if (base.optimizations() == 0) return json;
  const OptimizationReport& report = base.lastReport();
  json["usable"] = report.usable;
  json["termination"] = report.termination;
  json["rounds"] = report.rounds;
  json["iterations"] = report.iterations;
  json["initial_cost"] = report.initial_cost;
  json["final_cost"] = report.final_cost;
  json["odometry_scale"] = report.odometry_scale;
  json["frames"] = Json::array();
  for (const FrameAgreement& frames : report.frames)
    json["frames"].push_back(frameSummary(result, frames));
  return json;
}

Json fitSummary(const HeldBackFit& fit) {
  return {{"patches", fit.patches}, {"rms_m", fit.rms_m}};
}

Json refinementSummary(const JointAdjustmentReport& report) {
  return {{"rounds", report.rounds},
          {"surfels", report.surfels},
          {"pairs", report.pairs},
          {"held_back_before", fitSummary(report.before)},
          {"held_back_after", fitSummary(report.after)},
          {"kept", report.kept}};
}

}  // namespace

Json summarize(const RunResult& result, const std::vector<std::string>& not_written) {
  const BaseStation& base = result.base_station;
  const LoopCounts loops = countLoops(base);
  Json json;
  json["program"] = "mrpt-lamp " + std::string(kVersion);
  json["mrpt"] = mrpt::system::MRPT_getVersion();
  json["seed"] = result.config.run.seed;
  json["interrupted"] = result.interrupted;
  json["planar"] = base.graph().planar();
  json["key_nodes"] = base.graph().nodes().size();
  json["loops"] = {{"candidates", loops.candidates},
                   {"attempts", loops.attempts},
                   {"verified", loops.verified},
                   {"inliers", loops.inliers}};
  json["measurements"] = measurementSummary(base.graph());
  json["optimization"] = optimizationSummary(result);
  json["refinement"] = refinementSummary(base.refinement());
  json["robots"] = Json::array();
  for (const RobotId robot : result.robots.ids())
    json["robots"].push_back(robotSummary(result, robot));
  json["components"] = Json::array();
  const auto components = base.graph().components();
  for (size_t rank = 0; rank < components.size(); ++rank)
    json["components"].push_back(componentSummary(result, components[rank], rank));
  json["warnings"] = result.warnings;
  json["not_written"] = not_written;
  return json;
}

}  // namespace lamp
