#include "lamp/pose_graph/InitialGuess.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "guess/FixedNodes.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/core/TreeLayout.h"
#include "rejection/FrameAverages.h"
#include "solver/Information.h"

namespace lamp {

namespace {

/** Places the first key node of each chain of odometry. */
class FrameLayout {
 public:
  FrameLayout(const PoseGraph& graph, const OdometryChains& chains,
              const std::vector<bool>& admitted)
      : graph_(graph),
        chains_(chains),
        averages_(frameAverages(graph, chains, admitted)),
        world_T_first_(chains.size()) {
    while (const std::optional<int> next = nextSeed()) {
      world_T_first_[*next] = chains_.hasPrior(*next)
                                  ? chains_.prior(*next).a_T_b
                                  : graph_.node(chains_.first(*next)).world_T_base;
      while (placeByLoops()) {
      }
    }
  }

  std::vector<Pose3> take() const {
    std::vector<Pose3> poses;
    for (const std::optional<Pose3>& pose : world_T_first_) poses.push_back(*pose);
    return poses;
  }

 private:
  bool placed(int chain) const { return world_T_first_[chain].has_value(); }

  /** Of the chains not placed yet, the one with the most certain prior; the first if none has a
   * prior. */
  std::optional<int> nextSeed() const {
    std::optional<int> best;
    const auto uncertainty = [&](int chain) {
      return chains_.hasPrior(chain) ? chains_.prior(chain).covariance.trace()
                                     : std::numeric_limits<double>::infinity();
    };
    for (int chain = 0; chain < chains_.size(); ++chain)
      if (!placed(chain) && (!best || uncertainty(chain) < uncertainty(*best))) best = chain;
    return best;
  }

  /** Places a chain by the average with which most loops agree. */
  bool placeByLoops() {
    const FrameAverage* best = nullptr;
    for (const FrameAverage& average : averages_)
      if (placed(average.a) != placed(average.b) && isSurer(average) &&
          (!best || average.agreeing > best->agreeing))
        best = &average;
    if (!best) return false;
    if (placed(best->a))
      world_T_first_[best->b] = *world_T_first_[best->a] * best->a_T_b.a_T_b;
    else
      world_T_first_[best->a] = *world_T_first_[best->b] * best->a_T_b.a_T_b.inverse();
    return true;
  }

  /** Whether the average is more certain than what the priors say, if anything, and does not
   * contradict it. */
  bool isSurer(const FrameAverage& average) const {
    const auto by_priors = chains_.between(chains_.first(average.a), chains_.first(average.b));
    if (!by_priors) return true;
    const Vector6d apart = logSE3(by_priors->a_T_b.inverse() * average.a_T_b.a_T_b);
    constexpr double kProbability = 0.9999;
    return average.a_T_b.covariance.trace() < by_priors->covariance.trace() &&
           mahalanobis2(apart, by_priors->covariance + average.a_T_b.covariance) <
               chiSquareQuantile(kProbability, 6);
  }

  const PoseGraph& graph_;
  const OdometryChains& chains_;
  const std::vector<FrameAverage> averages_;
  std::vector<std::optional<Pose3>> world_T_first_;
};

}  // namespace

std::vector<Pose3> initialGuess(const PoseGraph& graph, const std::vector<bool>& admitted) {
  const OdometryChains chains(graph);
  const std::vector<Pose3> first = FrameLayout(graph, chains, admitted).take();
  std::vector<Pose3> poses;
  for (const Node& node : graph.nodes())
    poses.push_back(normalized(first[chains.chain(node.id)] * chains.poseFromFirst(node.id)));
  bendToFixedNodes(graph, chains, poses);
  return poses;
}

std::vector<Pose3> initialGuess(const PoseGraph& graph) {
  return initialGuess(graph, std::vector<bool>(graph.edges().size(), true));
}

std::vector<Pose3> spanningTreeGuess(const PoseGraph& graph) {
  std::vector<const Edge*> priors;
  for (const Edge& edge : graph.edges())
    if (edge.type == EdgeType::kPrior) priors.push_back(&edge);
  std::stable_sort(priors.begin(), priors.end(),
                   [](const Edge* a, const Edge* b) { return a->from < b->from; });

  TreeLayout layout(graph);
  for (const Node& node : graph.nodes())
    if (node.fixed) layout.place(graph.place(node.id), node.world_T_base);
  layout.spread();
  const auto seed = [&](KeyNodeId id, const Pose3& world_T_base) {
    if (layout.placed(graph.place(id))) return;
    layout.place(graph.place(id), world_T_base);
    layout.spread();
  };
  for (const Edge* prior : priors) seed(prior->from, prior->from_T_to);
  for (const RobotId robot : graph.robots())
    for (const KeyNodeId id : graph.robotNodes(robot)) seed(id, graph.node(id).world_T_base);
  return layout.poses();
}

}  // namespace lamp
