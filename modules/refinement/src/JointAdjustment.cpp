#include "lamp/refinement/JointAdjustment.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <map>
#include <utility>

#include "HeldBackFit.h"
#include "SurfelPairs.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "lamp/refinement/SharedSurfels.h"
#include "lamp/scans/RegistrationInformation.h"

namespace lamp {

namespace {

/** Rounds end when one has made patches held back come nearer by less than this. */
constexpr double kLeastGain = 0.01;
/** An edge of surfels that contradicts all others so much is left out from then on. */
constexpr double kInlierProbability = 0.9999;

/** Poses and landmarks, and how well they fit. */
struct Estimate {
  std::vector<Pose3> world_T_base;
  std::vector<std::optional<Eigen::Vector3d>> landmarks;
  std::vector<Surfel> surfels;
  HeldBackFit fit;
};

std::vector<SplitSurface> splitSurfaces(const std::vector<KeyedScanPtr>& scans) {
  std::vector<SplitSurface> surfaces(scans.size());
  tbb::parallel_for(size_t{0}, scans.size(),
                    [&](size_t i) { surfaces[i] = splitSurface(*scans[i]); });
  return surfaces;
}

Estimate estimateAt(std::vector<Pose3> poses, std::vector<std::optional<Eigen::Vector3d>> landmarks,
                    const std::vector<SplitSurface>& surfaces, double cell_m) {
  Estimate estimate{std::move(poses), std::move(landmarks), {}, {}};
  estimate.surfels = findSurfels(surfaces, estimate.world_T_base, cell_m);
  estimate.fit = heldBackFit(surfaces, estimate.surfels, estimate.world_T_base, cell_m);
  return estimate;
}

/** The edges of surfels at an estimate, one for each pair that the surfels say something of. */
std::vector<std::optional<Edge>> surfelEdges(const PoseGraph& graph,
                                             const std::vector<SurfelPair>& pairs,
                                             const Estimate& estimate) {
  const SharedSurfels shared(estimate.surfels, graph.nodes().size());
  std::vector<std::optional<Edge>> edges(pairs.size());
  tbb::parallel_for(size_t{0}, pairs.size(), [&](size_t k) {
    const auto [a, b] = pairs[k];
    const auto found = shared.registration(a, b, estimate.world_T_base);
    Edge edge;
    edge.type = EdgeType::kLoopClosure;
    edge.from = graph.nodes()[a].id;
    edge.to = graph.nodes()[b].id;
    edge.from_T_to =
        estimate.world_T_base[a].inverse() * estimate.world_T_base[b] * expSE3(found.step);
    edge.information =
        registrationInformation(found.surface, edge.from_T_to, {}, false).information;
    if (!edge.information.isZero()) edges[k] = edge;
  });
  return edges;
}

/** The part of an information matrix in the directions of which `known` says nothing. */
Matrix6d beyond(const Matrix6d& known, const Matrix6d& information) {
  constexpr double kZero = 1e-9;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> axes(known);
  Matrix6d projector = Matrix6d::Zero();
  for (int k = 0; k < 6; ++k)
    if (axes.eigenvalues()[k] <= kZero * axes.eigenvalues()[5])
      projector += axes.eigenvectors().col(k) * axes.eigenvectors().col(k).transpose();
  return projector * information * projector;
}

/** What an edge knows of the inverse of its relative pose. */
Matrix6d reversedInformation(const Edge& edge) {
  const Matrix6d Ad = adjoint(edge.from_T_to.inverse());
  return Ad.transpose() * edge.information * Ad;
}

/** Takes from the loop closures of the graph what edges of surfels between the same key nodes say,
 * too: along a tunnel a loop closure may know what surfels do not. */
void leaveRest(const std::vector<std::optional<Edge>>& of_surfels, PoseGraph& graph) {
  std::map<std::pair<KeyNodeId, KeyNodeId>, Matrix6d> known;
  for (const auto& edge : of_surfels) {
    if (!edge) continue;
    known[{edge->from, edge->to}] = edge->information;
    known[{edge->to, edge->from}] = reversedInformation(*edge);
  }
  for (Edge& edge : graph.edges()) {
    const auto found = known.find({edge.from, edge.to});
    if (edge.isLoopClosure() && !edge.pinned && found != known.end())
      edge.information = beyond(found->second, edge.information);
  }
}

/** Solves the graph once with edges of surfels. Pairs whose edges contradict the others are removed
 * for the rounds to come. */
OptimizationResult solve(const PoseGraph& graph, const Estimate& estimate,
                         std::vector<SurfelPair>& pairs) {
  PoseGraph adjusted = graph;
  for (size_t i = 0; i < graph.nodes().size(); ++i)
    adjusted.node(graph.nodes()[i].id).world_T_base = estimate.world_T_base[i];
  const auto edges = surfelEdges(graph, pairs, estimate);
  leaveRest(edges, adjusted);
  std::vector<SurfelPair> tied;
  for (size_t k = 0; k < pairs.size(); ++k) {
    if (!edges[k]) continue;
    adjusted.addEdge(*edges[k]);
    tied.push_back(pairs[k]);
  }
  std::vector<bool> admitted;
  for (const Edge& edge : adjusted.edges())
    admitted.push_back(edge.active() && !edge.information.isZero(0));
  Lm optimizer;
  OptimizationResult result = optimizer.optimize(adjusted, admitted);
  if (!result.report.usable) return result;
  static const double kThreshold = chiSquareQuantile(kInlierProbability, 6);
  const LoopVerdict* const first = result.loops.data() + result.loops.size() - tied.size();
  pairs.clear();
  for (size_t k = 0; k < tied.size(); ++k)
    if (first[k].chi2 <= kThreshold) pairs.push_back(tied[k]);
  return result;
}

bool mayAdjust(const PoseGraph& graph) {
  return std::none_of(graph.nodes().begin(), graph.nodes().end(),
                      [](const Node& node) { return node.planar || !isFinite(node.world_T_base); });
}

}  // namespace

void RefinementOptions::visit(OptionVisitor& v) {
  v("max_rounds", max_rounds, "",
    "maximum number of rounds in which all scans are adjusted together at the end; 0 leaves the "
    "poses to the loop closures",
    kNotNegative);
  v("cell_m", cell_m, "m",
    "edge of the cells in which surfaces are taken for planes; smaller ones suit small rooms",
    kPositive);
  v("min_shared", min_shared, "",
    "minimum fraction of its planes that a key node shares with another to be tied to it", kShare);
  v("max_distance_m", max_distance_m, "m", "key nodes farther apart are not tied", kPositive);
  v("pairs_per_node", pairs_per_node, "",
    "number of other key nodes that each one is tied to; more take more time and memory", {1});
}

JointAdjustmentResult adjustJointly(const PoseGraph& graph, const std::vector<KeyedScanPtr>& scans,
                                    const RefinementOptions& options,
                                    const std::function<bool(double share)>& go_on) {
  std::vector<Pose3> poses;
  for (const Node& node : graph.nodes()) poses.push_back(node.world_T_base);
  std::vector<std::optional<Eigen::Vector3d>> landmarks(graph.landmarks().size());
  JointAdjustmentResult result{poses, landmarks, {}};
  if (!mayAdjust(graph) || options.max_rounds == 0 || !go_on(0)) return result;

  const std::vector<SplitSurface> surfaces = splitSurfaces(scans);
  Estimate best = estimateAt(poses, landmarks, surfaces, options.cell_m);
  JointAdjustmentReport& report = result.report;
  report.before = best.fit;
  report.surfels = best.surfels.size();
  std::vector<SurfelPair> pairs =
      chooseSurfelPairs(graph, SharedSurfels(best.surfels, graph.nodes().size()), options);
  report.pairs = pairs.size();
  for (bool helps = !pairs.empty(); helps && report.rounds < options.max_rounds; ++report.rounds) {
    if (!go_on((report.rounds + 1.0) / (options.max_rounds + 1.0))) break;
    OptimizationResult solved = solve(graph, best, pairs);
    if (!solved.report.usable) break;
    Estimate next = estimateAt(std::move(solved.world_T_base), std::move(solved.landmarks),
                               surfaces, options.cell_m);
    helps = next.fit.rms_m < (1 - kLeastGain) * best.fit.rms_m;
    if (next.fit.rms_m >= best.fit.rms_m) continue;
    best = std::move(next);
    report.kept = true;
  }
  report.after = best.fit;
  result.world_T_base = std::move(best.world_T_base);
  result.landmarks = std::move(best.landmarks);
  return result;
}

}  // namespace lamp
