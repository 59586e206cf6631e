#include "lamp/loop_candidates/RadiusGenerators.h"

#include "lamp/loop_candidates/GlobalSearch.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

std::vector<LoopClosureCandidate> RadiusGenerator::propose(const PoseGraph& graph,
                                                           KeyNodeId current) const {
  const Limits limits = this->limits();
  const Eigen::Vector3d here = graph.node(current).world_T_base.translation();
  std::vector<LoopClosureCandidate> candidates;
  for (const RobotId robot : graph.robots()) {
    const bool own = robot == current.robot;
    if (!own && !graph.shareFrame(robot, current.robot)) continue;
    std::vector<std::pair<double, KeyNodeId>> near;
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
    for (const auto& [distance, other] : near) {
      LoopClosureCandidate candidate{other, current, getLoggerName(), 0};
      if (graph.place(candidate.from) > graph.place(candidate.to))
        std::swap(candidate.from, candidate.to);
      candidates.push_back(candidate);
    }
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
  mrpt::rtti::registerClass(CLASS_ID(GlobalSearch));
}

}  // namespace lamp
