#include "SurfelPairs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "ShuffledBits.h"
#include "lamp/pose_graph/MarginalCovariances.h"

namespace lamp {

namespace {

/** Key nodes of one robot that lie no farther apart in sequence are tied first. */
constexpr uint32_t kNeighbors = 2;
/** A pair takes part if the graph knows the distances of its surfels to this share of a cell. */
constexpr double kMaxUncertainty = 0.25;

std::vector<Pose3> posesOf(const PoseGraph& graph) {
  std::vector<Pose3> poses;
  for (const Node& node : graph.nodes()) poses.push_back(node.world_T_base);
  return poses;
}

/** For each node the number of its component. */
std::vector<size_t> componentsOf(const PoseGraph& graph) {
  std::vector<size_t> numbers(graph.nodes().size());
  size_t number = 0;
  for (const Component& component : graph.components()) {
    for (const KeyNodeId id : component.nodes) numbers[graph.place(id)] = number;
    ++number;
  }
  return numbers;
}

std::vector<SurfelPair> overlappingPairs(const PoseGraph& graph, const SharedSurfels& shared,
                                         const RefinementOptions& options) {
  const std::vector<Node>& nodes = graph.nodes();
  const std::vector<size_t> component = componentsOf(graph);
  std::vector<std::vector<SurfelPair>> of_node(nodes.size());
  tbb::parallel_for(size_t{0}, nodes.size(), [&](size_t a) {
    for (size_t b = a + 1; b < nodes.size(); ++b) {
      const Eigen::Vector3d apart =
          nodes[a].world_T_base.translation() - nodes[b].world_T_base.translation();
      if (component[a] == component[b] && apart.norm() <= options.max_distance_m &&
          shared.share(a, b) >= options.min_shared)
        of_node[a].push_back({a, b});
    }
  });
  std::vector<SurfelPair> pairs;
  for (const auto& of_one : of_node) pairs.insert(pairs.end(), of_one.begin(), of_one.end());
  return pairs;
}

bool areNeighbors(KeyNodeId a, KeyNodeId b) {
  return a.robot == b.robot &&
         std::max(a.index, b.index) - std::min(a.index, b.index) <= kNeighbors;
}

std::vector<SurfelPair> spread(const PoseGraph& graph, std::vector<SurfelPair> pairs,
                               int pairs_per_node) {
  const auto rank = [&](const SurfelPair& pair) {
    const bool neighbors = areNeighbors(graph.nodes()[pair.a].id, graph.nodes()[pair.b].id);
    return std::tuple(neighbors ? 0 : 1, shuffledBits(pair.a << 32 | pair.b));
  };
  std::sort(pairs.begin(), pairs.end(),
            [&](const SurfelPair& x, const SurfelPair& y) { return rank(x) < rank(y); });
  std::vector<int> count(graph.nodes().size(), 0);
  std::vector<SurfelPair> chosen;
  for (const SurfelPair& pair : pairs) {
    if (count[pair.a] >= pairs_per_node && count[pair.b] >= pairs_per_node) continue;
    ++count[pair.a];
    ++count[pair.b];
    chosen.push_back(pair);
  }
  return chosen;
}

/** R.m.s. of what the covariance of `a_T_b` lets the distances between both views of a surfel be,
 * metres. */
double uncertainty(const MatchedSurface& surface, const Pose3& a_T_b, const Matrix6d& covariance) {
  const Matrix6d J = adjoint(Eigen::Translation3d(-surface.pivot) * a_T_b);
  const Matrix6d about_pivot = J * covariance * J.transpose();
  return std::sqrt((surface.information * about_pivot).trace() / surface.weights);
}

std::vector<SurfelPair> certain(const PoseGraph& graph, const SharedSurfels& shared,
                                const std::vector<SurfelPair>& pairs, double max_uncertainty_m) {
  const std::vector<Pose3> poses = posesOf(graph);
  const MarginalCovariances covariances(graph);
  std::map<size_t, std::vector<SurfelPair>> by_first;
  for (const SurfelPair& pair : pairs) by_first[pair.a].push_back(pair);
  std::vector<SurfelPair> chosen;
  for (const auto& [a, of_one] : by_first) {
    std::vector<KeyNodeId> others;
    for (const SurfelPair& pair : of_one) others.push_back(graph.nodes()[pair.b].id);
    const auto relative = covariances.relativeCovariances(graph.nodes()[a].id, others);
    for (size_t k = 0; k < of_one.size(); ++k) {
      const MatchedSurface surface = shared.registration(a, of_one[k].b, poses).surface;
      const Pose3 a_T_b = poses[a].inverse() * poses[of_one[k].b];
      if (relative[k] && uncertainty(surface, a_T_b, *relative[k]) <= max_uncertainty_m)
        chosen.push_back(of_one[k]);
    }
  }
  return chosen;
}

}  // namespace

std::vector<SurfelPair> chooseSurfelPairs(const PoseGraph& graph, const SharedSurfels& shared,
                                          const RefinementOptions& options) {
  return certain(graph, shared,
                 spread(graph, overlappingPairs(graph, shared, options), options.pairs_per_node),
                 kMaxUncertainty * options.cell_m);
}

}  // namespace lamp
