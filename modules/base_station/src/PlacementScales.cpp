#include "lamp/base_station/PlacementScales.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

namespace lamp {

namespace {

/** Bounds of the work: pairs compared for each placement, key nodes of b that alternatives are
 * sought for, and key nodes of a that they are sought at. */
constexpr size_t kMaxPairs = 24, kMaxSeeds = 2, kMaxPlaces = 30;
/** How far a key node may settle from where a placement puts it, and how far apart two placements
 * are then different. */
constexpr double kDrift_m = 1.0, kDrift_deg = 10.0;

double degrees(const Pose3& motion) {
  return rotationAngle(motion) * 180.0 / M_PI;
}

/** Whether drift of the two maps explains the motion. */
bool isDrift(const Pose3& motion) {
  return motion.translation().norm() < kDrift_m && degrees(motion) < kDrift_deg;
}

/** At most `most` of them, evenly spaced. */
template <class T>
std::vector<T> thinned(const std::vector<T>& all, size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> result;
  for (size_t k = 0; k < most; ++k) result.push_back(all[(2 * k + 1) * all.size() / (2 * most)]);
  return result;
}

/** Index and distance of the key node nearest to a point of the map. */
std::pair<size_t, double> nearest(const RobotMap& map, const Eigen::Vector3d& point) {
  std::pair<size_t, double> best{0, INFINITY};
  for (size_t i = 0; i < map.nodes.size(); ++i) {
    const double distance = (map.map_T_node[i].translation() - point).norm();
    if (distance < best.second) best = {i, distance};
  }
  return best;
}

/** Key nodes where a look-alike may be: half of them the nearest ones, as the next pillar of a row
 * is, half all over the map. */
std::set<size_t> placesAround(const RobotMap& map, size_t center) {
  std::vector<size_t> all(map.nodes.size());
  std::iota(all.begin(), all.end(), size_t{0});
  const std::vector<size_t> far = thinned(all, kMaxPlaces / 2);
  const auto distance = [&](size_t i) {
    return (map.map_T_node[i].translation() - map.map_T_node[center].translation()).norm();
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](size_t i, size_t j) { return distance(i) < distance(j); });
  all.resize(std::min(all.size(), kMaxPlaces / 2));
  std::set<size_t> places(all.begin(), all.end());
  places.insert(far.begin(), far.end());
  return places;
}

/** Distance that most of the points of both maps' scans lie within. */
double reach(const RobotMap& a, const RobotMap& b, PreparedScanStore& scans) {
  constexpr double kMost = 0.8;
  constexpr size_t kScans = 5;
  std::vector<float> ranges{0};
  for (const RobotMap* map : {&a, &b})
    for (const KeyNodeId id : thinned(map->nodes, kScans)) {
      const PreparedScanPtr scan = scans.get(scans.ofStrangers(id));
      for (const uint32_t i : scan->own()) ranges.push_back(scan->points()[i].norm());
    }
  const auto most =
      ranges.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), most, ranges.end());
  return *most;
}

}  // namespace

bool samePlacement(const Pose3& a_T_node, const Pose3& other_a_T_node) {
  const Pose3 motion = a_T_node.inverse() * other_a_T_node;
  return motion.translation().norm() < 2 * kDrift_m && degrees(motion) < 2 * kDrift_deg;
}

PlacementScales::PlacementScales(const RobotMap& a, const RobotMap& b,
                                 const LoopClosureComputation& computation,
                                 PreparedScanStore& scans)
    : a_(a), b_(b), computation_(computation), scans_(scans), reach_m_(reach(a, b, scans)) {}

double ComparedPair::agreeing() const {
  return static_cast<double>(of_a.agreeing.size() + of_b.agreeing.size());
}

double ComparedPair::contradicting() const {
  return static_cast<double>(of_a.contradicting.size() + of_b.contradicting.size());
}

double Placement::agreeing() const {
  double sum = 0;
  for (const ComparedPair& pair : pairs) sum += pair.agreeing();
  return pairs.empty() ? 0 : sum * near / static_cast<double>(pairs.size());
}

Placement PlacementScales::weigh(const Pose3& a_T_b) const {
  const std::vector<Pair> near = nearPairs(a_T_b), pairs = thinned(near, kMaxPairs);
  Placement placement{a_T_b, std::vector<ComparedPair>(pairs.size()),
                      static_cast<double>(near.size())};
  tbb::parallel_for(size_t{0}, pairs.size(), [&](size_t k) {
    const KeyNodeId a = a_.nodes[pairs[k].a], b = b_.nodes[pairs[k].b];
    const PreparedScanPtr of_a = scan(a), of_b = scan(b);
    const Pose3 pose = settled({pairs[k], relativePose(pairs[k], a_T_b)});
    placement.pairs[k] = {a, b, patchEvidence(*of_a, *of_b, pose.inverse()),
                          patchEvidence(*of_b, *of_a, pose)};
  });
  return placement;
}

std::vector<Pose3> PlacementScales::alternatives(const Pose3& a_T_b) const {
  const std::vector<Start> tried = starts(a_T_b);
  std::vector<std::optional<Pose3>> found(tried.size());
  tbb::parallel_for(size_t{0}, tried.size(), [&](size_t k) {
    const LoopClosureAttempt attempt = registered(tried[k]);
    if (attempt.accepted)
      found[k] = a_.map_T_node[tried[k].pair.a] * attempt.result.target_T_source *
                 b_.map_T_node[tried[k].pair.b].inverse();
  });
  std::vector<Pose3> result;
  for (size_t k = 0; k < tried.size(); ++k) {
    if (!found[k]) continue;
    const Pose3& node = b_.map_T_node[tried[k].pair.b];
    const auto same = [&](const Pose3& other) {
      return samePlacement(*found[k] * node, other * node);
    };
    if (!same(a_T_b) && std::none_of(result.begin(), result.end(), same))
      result.push_back(*found[k]);
  }
  return result;
}

std::vector<PlacedLoop> PlacementScales::loops(const Pose3& a_T_b) const {
  const std::vector<Pair> pairs = thinned(nearPairs(a_T_b), kMaxPairs);
  std::vector<PlacedLoop> all(pairs.size());
  tbb::parallel_for(size_t{0}, pairs.size(), [&](size_t k) {
    const Pose3 guess = relativePose(pairs[k], a_T_b);
    all[k] = {
        a_.nodes[pairs[k].a], b_.nodes[pairs[k].b], {guess, {}}, registered({pairs[k], guess})};
  });
  std::vector<PlacedLoop> result;
  for (PlacedLoop& loop : all) {
    const Pose3 motion = loop.guess.target_T_source.inverse() * loop.attempt.result.target_T_source;
    if (loop.attempt.accepted && isDrift(motion)) result.push_back(std::move(loop));
  }
  return result;
}

/** Each key node that comes within reach, with the other map's nearest one. */
std::vector<PlacementScales::Pair> PlacementScales::nearPairs(const Pose3& a_T_b) const {
  std::set<std::pair<size_t, size_t>> pairs;
  for (size_t b = 0; b < b_.nodes.size(); ++b)
    if (const auto [a, distance] = nearest(a_, a_T_b * b_.map_T_node[b].translation());
        distance < reach_m_)
      pairs.insert({a, b});
  for (size_t a = 0; a < a_.nodes.size(); ++a)
    if (const auto [b, distance] = nearest(b_, a_T_b.inverse() * a_.map_T_node[a].translation());
        distance < reach_m_)
      pairs.insert({a, b});
  std::vector<Pair> result;
  for (const auto& [a, b] : pairs) result.push_back({a, b});
  return result;
}

std::vector<PlacementScales::Start> PlacementScales::starts(const Pose3& a_T_b) const {
  std::vector<Start> result;
  for (const Pair& seed : thinned(nearPairs(a_T_b), kMaxSeeds))
    for (const size_t place : placesAround(a_, seed.a))
      for (const double turn : {0.0, M_PI})
        result.push_back({{place, seed.b}, planarPose(0, 0, turn) * relativePose(seed, a_T_b)});
  return result;
}

Pose3 PlacementScales::relativePose(const Pair& pair, const Pose3& a_T_b) const {
  return a_.map_T_node[pair.a].inverse() * a_T_b * b_.map_T_node[pair.b];
}

/** Where the pair fits best near the start; the start if that is farther than drift explains. */
Pose3 PlacementScales::settled(const Start& start) const {
  Hypothesis hypothesis;
  hypothesis.target_T_source = start.pose;
  hypothesis.accuracy_m = kDrift_m;
  const RegistrationResult result =
      computation_.refine(*scan(b_.nodes[start.pair.b]), *scan(a_.nodes[start.pair.a]), hypothesis);
  return result.converged && isDrift(start.pose.inverse() * result.target_T_source)
             ? result.target_T_source
             : start.pose;
}

LoopClosureAttempt PlacementScales::registered(const Start& start) const {
  Hypothesis hypothesis;
  hypothesis.target_T_source = start.pose;
  return computation_.follow(*scan(b_.nodes[start.pair.b]), *scan(a_.nodes[start.pair.a]),
                             {start.pose, {}}, hypothesis);
}

}  // namespace lamp
