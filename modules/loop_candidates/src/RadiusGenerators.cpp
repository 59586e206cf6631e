#include "lamp/loop_candidates/RadiusGenerators.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "lamp/core/Csv.h"
#include "lamp/loop_candidates/Neighbors.h"
#include "lamp/loop_candidates/PlaceRecognition.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(CandidateGenerator, Stage, lamp)
IMPLEMENTS_VIRTUAL_MRPT_OBJECT(RadiusGenerator, lamp::CandidateGenerator, lamp)
IMPLEMENTS_MRPT_OBJECT(FixedRadius, lamp::RadiusGenerator, lamp)
IMPLEMENTS_MRPT_OBJECT(AdaptiveRadius, lamp::RadiusGenerator, lamp)

namespace lamp {

namespace {

uint32_t gap(uint32_t a, uint32_t b) {
  return a > b ? a - b : b - a;
}

}  // namespace

std::vector<RadiusGenerator::Near> RadiusGenerator::nearestOf(const PoseGraph& graph, RobotId robot,
                                                              KeyNodeId current) const {
  const Limits limits = this->limits();
  const Eigen::Vector3d here = graph.node(current).world_T_base.translation();
  const bool own = robot == current.robot;
  std::vector<Near> near;
  for (const KeyNodeId other : graph.robotNodes(robot)) {
    if (own && gap(other.index, current.index) < static_cast<uint32_t>(limits.min_index_gap))
      continue;
    const double distance = (graph.node(other).world_T_base.translation() - here).norm();
    const double radius =
        own ? radiusWithin(current.index, other.index) : radiusBetween(current.index);
    if (distance <= radius) near.emplace_back(distance, other);
  }
  std::sort(near.begin(), near.end());
  if (near.size() > static_cast<size_t>(limits.max_per_robot))
    near.resize(static_cast<size_t>(limits.max_per_robot));
  return near;
}

std::vector<LoopClosureCandidate> RadiusGenerator::propose(const PoseGraph& graph,
                                                           KeyNodeId current) {
  std::map<RobotId, std::vector<Near>> by_robot;
  std::vector<Near> nearest_of_others;
  for (const RobotId robot : graph.robots()) {
    if (!graph.shareFrame(robot, current.robot)) continue;
    auto near = nearestOf(graph, robot, current);
    if (near.empty()) continue;
    if (robot != current.robot) nearest_of_others.push_back(near.front());
    by_robot.emplace(robot, std::move(near));
  }
  std::sort(nearest_of_others.begin(), nearest_of_others.end());
  for (size_t i = static_cast<size_t>(limits().max_other_robots); i < nearest_of_others.size(); ++i)
    by_robot.erase(nearest_of_others[i].second.robot);

  std::vector<LoopClosureCandidate> candidates;
  for (const auto& [robot, near] : by_robot)
    for (const auto& [distance, other] : near) {
      LoopClosureCandidate candidate{other, current, getLoggerName()};
      candidate.why = "at " + formatFixed(distance, 1) + " m";
      if (graph.place(candidate.from) > graph.place(candidate.to))
        std::swap(candidate.from, candidate.to);
      candidates.push_back(candidate);
    }
  return candidates;
}

void FixedRadiusOptions::visit(OptionVisitor& v) {
  v("radius_m", radius_m, "m", "search radius within a robot", kPositive);
  v("between_robots_radius_m", between_robots_radius_m, "m", "search radius between robots",
    kPositive);
  v("min_index_gap", min_index_gap, "key nodes",
    "key nodes of one robot closer than this in sequence are not loop closure candidates", {1});
  v("max_per_robot", max_per_robot, "",
    "maximum number of candidates per key node and robot, nearest first; more find more loop "
    "closures and take more time",
    {1});
  v("max_other_robots", max_other_robots, "",
    "maximum number of other robots among a key node's candidates, nearest first; bounds the time "
    "that many robots in one place take",
    {1});
}

void AdaptiveRadiusOptions::visit(OptionVisitor& v) {
  v("alpha_m", alpha_m, "m", "growth of the search radius per key node travelled", kPositive);
  v("min_radius_m", min_radius_m, "m", "minimum search radius within a robot", kPositive);
  v("max_radius_m", max_radius_m, "m", "maximum search radius within a robot", kPositive);
  v("between_robots_min_radius_m", between_robots_min_radius_m, "m",
    "minimum search radius between robots", kPositive);
  v("between_robots_max_radius_m", between_robots_max_radius_m, "m",
    "maximum search radius between robots", kPositive);
  v("min_index_gap", min_index_gap, "key nodes",
    "key nodes of one robot closer than this in sequence are not loop closure candidates", {1});
  v("max_per_robot", max_per_robot, "",
    "maximum number of candidates per key node and robot, nearest first; more find more loop "
    "closures and take more time",
    {1});
  v("max_other_robots", max_other_robots, "",
    "maximum number of other robots among a key node's candidates, nearest first; bounds the time "
    "that many robots in one place take",
    {1});
}

double AdaptiveRadius::radiusWithin(uint32_t current_index, uint32_t candidate_index) const {
  return std::min(
      options.max_radius_m,
      std::max(options.min_radius_m, options.alpha_m * gap(current_index, candidate_index)));
}

double AdaptiveRadius::radiusBetween(uint32_t current_index) const {
  return std::min(options.between_robots_max_radius_m,
                  std::max(options.between_robots_min_radius_m, options.alpha_m * current_index));
}

void registerAllClasses_lamp_loop_candidates() {
  mrpt::rtti::registerClass(CLASS_ID(CandidateGenerator));
  mrpt::rtti::registerClass(CLASS_ID(RadiusGenerator));
  mrpt::rtti::registerClass(CLASS_ID(FixedRadius));
  mrpt::rtti::registerClass(CLASS_ID(AdaptiveRadius));
  mrpt::rtti::registerClass(CLASS_ID(Neighbors));
  mrpt::rtti::registerClass(CLASS_ID(PlaceRecognition));
}

}  // namespace lamp
