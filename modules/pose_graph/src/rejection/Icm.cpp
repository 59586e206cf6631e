#include "lamp/pose_graph/Icm.h"

#include <algorithm>
#include <cstdlib>

#include "lamp/core/ChiSquare.h"
#include "rejection/GrowingClique.h"
#include "rejection/LoopCycles.h"

IMPLEMENTS_MRPT_OBJECT(Icm, OutlierRejection, lamp)

namespace lamp {

namespace {

const char* const kUncertainty = "uncertainty";
const char* const kPerNode = "per_node";

/** Whether cycles close, by the test that the options choose. */
class Consistency {
 public:
  Consistency(const OdometryChains& chains, const IcmOptions& options, bool planar)
      : chains_(chains),
        options_(options),
        threshold_(chiSquareQuantile(options.inlier_probability, planar ? 3 : 6)) {}

  bool agree(const DirectedLoop& a, const DirectedLoop& b) const {
    if (options_.test == kPerNode)
      return withinThresholds(a.measured.a_T_b.inverse() * otherWay(a, b, chains_).a_T_b,
                              nodesBetween(a.from, b.from) + nodesBetween(a.to, b.to));
    return cycle(a, b, chains_).distance2() <= threshold_;
  }

  /** Only LAMP's thresholds are compared with odometry here; with uncertainties that is
   * OdometryGate's task. */
  bool agreesWithOdometry(const DirectedLoop& loop) const {
    if (options_.test != kPerNode || chains_.chain(loop.from) != chains_.chain(loop.to))
      return true;
    const Pose3 odometry = chains_.between(loop.from, loop.to)->a_T_b;
    return withinThresholds(loop.measured.a_T_b.inverse() * odometry,
                            nodesBetween(loop.from, loop.to));
  }

 private:
  bool withinThresholds(const Pose3& cycle, int nodes) const {
    const double allowed = std::max(1, nodes);
    return cycle.translation().norm() <= allowed * options_.max_translation_per_node_m &&
           rotationAngle(cycle) <= allowed * options_.max_rotation_per_node_rad;
  }

  const OdometryChains& chains_;
  const IcmOptions& options_;
  const double threshold_;
};

}  // namespace

/** The loops between two chains that have been compared so far. */
class Icm::Group {
 public:
  explicit Group(size_t max_steps) : clique_(max_steps) {}

  /** Whether the new list begins with these loops, unchanged. */
  bool startOf(const std::vector<DirectedLoop>& loops) const {
    return loops_.size() <= loops.size() &&
           std::equal(loops_.begin(), loops_.end(), loops.begin(),
                      [](const DirectedLoop& a, const DirectedLoop& b) {
                        return a.edge == b.edge && a.from == b.from && a.to == b.to &&
                               a.measured.a_T_b.matrix() == b.measured.a_T_b.matrix();
                      });
  }

  void add(const std::vector<DirectedLoop>& loops, const Consistency& consistency) {
    for (size_t i = loops_.size(); i < loops.size(); ++i) {
      std::vector<bool> neighbours;
      for (const DirectedLoop& other : loops_)
        neighbours.push_back(consistency.agree(other, loops[i]));
      clique_.add(neighbours);
      loops_.push_back(loops[i]);
    }
  }

  void rejectOthers(std::vector<bool>& admitted) const {
    for (const DirectedLoop& loop : loops_) admitted[loop.edge] = false;
    for (const int member : clique_.clique()) admitted[loops_[member].edge] = true;
  }

 private:
  std::vector<DirectedLoop> loops_;
  GrowingClique clique_;
};

Icm::Icm(const IcmOptions& options) : options_(options) {}
Icm::~Icm() = default;

void IcmOptions::visit(OptionVisitor& v) {
  v("test", test, "consistency test for two loop closures", {kUncertainty, kPerNode});
  v("inlier_probability", inlier_probability, "",
    "test uncertainty: probability that two true loop closures are found consistent",
    {0.0, 1.0 - 1e-12});
  v("max_translation_per_node_m", max_translation_per_node_m, "m",
    "test per_node: maximum translation error of a cycle per key node on it", kPositive);
  v("max_rotation_per_node_rad", max_rotation_per_node_rad, "rad",
    "test per_node: maximum rotation error of a cycle per key node on it", kPositive);
  v("max_search_steps", max_search_steps, "",
    "maximum number of search steps per new loop closure; the largest consistent set is exact "
    "within them",
    {1});
}

Admission Icm::reject(const PoseGraph& graph, Admission before) {
  std::vector<bool>& admitted = before.admitted;
  const OdometryChains chains(graph);
  const Consistency consistency(chains, options_, graph.planar());
  std::map<std::pair<int, int>, std::vector<DirectedLoop>> loops;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.isLoopClosure() || edge.pinned || !admitted[e]) continue;
    const DirectedLoop loop = directed(e, edge, graph.planar());
    if (consistency.agreesWithOdometry(loop))
      loops[{chains.chain(loop.from), chains.chain(loop.to)}].push_back(loop);
    else
      admitted[e] = false;
  }
  for (const auto& [key, of_group] : loops) {
    std::shared_ptr<Group>& group = groups_[key];
    if (!group || !group->startOf(of_group))
      group = std::make_shared<Group>(static_cast<size_t>(options_.max_search_steps));
    group->add(of_group, consistency);
    group->rejectOthers(admitted);
  }
  return before;
}

}  // namespace lamp
