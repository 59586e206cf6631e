#include "lamp/loop_candidates/PlaceRecognition.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "lamp/core/Csv.h"

IMPLEMENTS_MRPT_OBJECT(PlaceRecognition, lamp::CandidateGenerator, lamp)

namespace lamp {

namespace {

/** How many places are compared at all headings: those whose magnitudes are most alike. */
constexpr size_t kShortlist = 30;

}  // namespace

void PlaceRecognitionOptions::visit(OptionVisitor& v) {
  v("neighborhood_m", neighborhood_m, "m",
    "distance before and after a key node whose scans show what its surroundings look like",
    kNotNegative);
  v("radius_m", radius_m, "m", "what lies farther from a key node does not count", kPositive);
  v("planar_radius_m", planar_radius_m, "m", "the same for robots in the plane", kPositive);
  v("min_similarity", min_similarity, "",
    "minimum similarity of two places, as in the ledger; less finds robots that share little, and "
    "takes more time",
    kShare);
  v("planar_min_similarity", planar_min_similarity, "", "the same for robots in the plane", kShare);
  v("max_per_robot", max_per_robot, "",
    "maximum number of candidates per key node and robot that does not yet share its frame; more "
    "join robots sooner and take more time",
    {1});
  v("max_other_robots", max_other_robots, "",
    "maximum number of such robots per key node, those that have seen what is most alike; bounds "
    "the time that many robots take",
    {1});
}

void PlaceRecognition::add(const KeyNodePacket& packet) {
  Robot& robot = robots_[packet.id.robot];
  Station station{packet.id, 0, packet.odom_T_base, packet.scan, packet.planar};
  if (!robot.stations.empty()) {
    const Station& before = robot.stations.back();
    const Pose3 step = before.odom_T_base.inverse() * station.odom_T_base;
    station.travelled_m = before.travelled_m + step.translation().norm();
  }
  robot.stations.push_back(std::move(station));
  describe(robot, false);
}

void PlaceRecognition::end(RobotId robot) {
  describe(robots_[robot], true);
}

void PlaceRecognition::describe(Robot& robot, bool ended) const {
  const auto isComplete = [&](const Station& station) {
    return ended ||
           robot.stations.back().travelled_m - station.travelled_m >= options.neighborhood_m;
  };
  while (robot.described < robot.stations.size() && isComplete(robot.stations[robot.described])) {
    Place place = placeAt(robot, robot.described);
    const Eigen::VectorXf& magnitudes = place.descriptor.magnitudes();
    const auto column = static_cast<Eigen::Index>(robot.places.size());
    if (column == robot.magnitudes.cols())
      robot.magnitudes.conservativeResize(magnitudes.size(),
                                          std::max<Eigen::Index>(64, 2 * column));
    robot.magnitudes.col(column) = magnitudes;
    robot.places.push_back(std::move(place));
    ++robot.described;
    const double here = robot.stations[robot.described - 1].travelled_m;
    while (robot.described > 1 &&
           here - robot.stations.front().travelled_m > options.neighborhood_m) {
      robot.stations.pop_front();
      --robot.described;
    }
  }
}

PlaceRecognition::Place PlaceRecognition::placeAt(const Robot& robot, size_t station) const {
  const Station& here = robot.stations[station];
  const Eigen::Matrix3d level_R_base = levelFrame(here.odom_T_base);
  const Pose3 level_T_odom = Pose3(level_R_base) * here.odom_T_base.inverse();
  const double radius = here.planar ? options.planar_radius_m : options.radius_m;
  std::vector<PlacedScan> scans;
  for (const Station& other : robot.stations)
    if (std::abs(other.travelled_m - here.travelled_m) <= options.neighborhood_m)
      scans.push_back({other.scan, level_T_odom * other.odom_T_base});
  const PlaceDescriptor descriptor(surroundings(scans, radius, here.planar), radius, here.planar);
  return {here.id, descriptor, level_R_base, here.travelled_m};
}

std::vector<PlaceRecognition::Alike> PlaceRecognition::mostAlike(const Robot& robot,
                                                                 const Place& place) const {
  std::vector<Alike> alike;
  if (robot.places.empty() || robot.magnitudes.rows() != place.descriptor.magnitudes().size())
    return alike;
  const double least =
      place.descriptor.planar() ? options.planar_min_similarity : options.min_similarity;
  const auto count = static_cast<Eigen::Index>(robot.places.size());
  const Eigen::VectorXf products =
      robot.magnitudes.leftCols(count).transpose() * place.descriptor.magnitudes();
  std::vector<std::pair<float, size_t>> shortlist;
  for (Eigen::Index i = 0; i < count; ++i)
    shortlist.emplace_back(-products[i], static_cast<size_t>(i));
  const size_t kept = std::min(kShortlist, shortlist.size());
  std::partial_sort(shortlist.begin(), shortlist.begin() + static_cast<std::ptrdiff_t>(kept),
                    shortlist.end());
  shortlist.resize(kept);
  for (const auto& [product, i] : shortlist) {
    const PlaceMatch found = match(robot.places[i].descriptor, place.descriptor);
    if (found.similarity >= least) alike.push_back({found, &robot.places[i]});
  }
  std::stable_sort(alike.begin(), alike.end(), [](const Alike& a, const Alike& b) {
    return a.match.similarity > b.match.similarity;
  });
  if (alike.size() > static_cast<size_t>(options.max_per_robot))
    alike.resize(static_cast<size_t>(options.max_per_robot));
  return alike;
}

std::vector<PlaceRecognition::Alike> PlaceRecognition::confirmed(
    const std::vector<Alike>& alike, const std::vector<double>& previous) const {
  std::vector<Alike> result;
  for (const Alike& candidate : alike) {
    const bool agrees = std::any_of(previous.begin(), previous.end(), [&](double travelled_m) {
      return std::abs(candidate.other->travelled_m - travelled_m) <= options.neighborhood_m / 2;
    });
    if (agrees) result.push_back(candidate);
  }
  return result;
}

LoopClosureCandidate PlaceRecognition::candidate(const PoseGraph& graph, const Place& place,
                                                 const Alike& alike) const {
  const Eigen::AngleAxisd turn(alike.match.heading, Eigen::Vector3d::UnitZ());
  const Pose3 other_T_place(alike.other->level_R_base.transpose() * turn * place.level_R_base);
  LoopClosureCandidate candidate{alike.other->id, place.id, getLoggerName()};
  candidate.why = "similarity " + formatFixed(alike.match.similarity, 2);
  candidate.recognized = other_T_place;
  if (graph.place(candidate.from) > graph.place(candidate.to)) {
    std::swap(candidate.from, candidate.to);
    candidate.recognized = other_T_place.inverse();
  }
  return candidate;
}

std::vector<LoopClosureCandidate> PlaceRecognition::propose(const PoseGraph& graph,
                                                            KeyNodeId current) {
  std::vector<LoopClosureCandidate> candidates;
  Robot& own = robots_[current.robot];
  for (; own.asked < own.places.size(); ++own.asked) {
    const Place& place = own.places[own.asked];
    std::vector<std::vector<Alike>> by_robot;
    for (const auto& [id, robot] : robots_) {
      if (id == current.robot || graph.shareFrame(id, current.robot)) continue;
      const std::vector<Alike> alike = mostAlike(robot, place);
      std::vector<double>& previous = own.recognized[id];
      std::vector<Alike> twice = confirmed(alike, previous);
      previous.clear();
      for (const Alike& other : alike) previous.push_back(other.other->travelled_m);
      if (!twice.empty()) by_robot.push_back(std::move(twice));
    }
    std::stable_sort(by_robot.begin(), by_robot.end(), [](const auto& a, const auto& b) {
      return a.front().match.similarity > b.front().match.similarity;
    });
    if (by_robot.size() > static_cast<size_t>(options.max_other_robots))
      by_robot.resize(static_cast<size_t>(options.max_other_robots));
    for (const std::vector<Alike>& alike : by_robot)
      for (const Alike& other : alike) candidates.push_back(candidate(graph, place, other));
  }
  return candidates;
}

}  // namespace lamp
