#include "lamp/registration/GraphGuess.h"

#include <map>

namespace lamp {

Guess graphGuess(const PoseGraph& graph, const LoopClosureCandidate& candidate) {
  if (candidate.recognized && !graph.shareFrame(candidate.from.robot, candidate.to.robot))
    return {*candidate.recognized, std::nullopt};
  return {graph.node(candidate.from).world_T_base.inverse() * graph.node(candidate.to).world_T_base,
          std::nullopt};
}

std::vector<Guess> graphGuesses(const PoseGraph& graph,
                                const std::vector<LoopClosureCandidate>& candidates,
                                const UncertaintyQuery& uncertainty) {
  std::vector<Guess> result(candidates.size());
  std::map<KeyNodeId, std::vector<size_t>> by_newer;
  for (size_t i = 0; i < candidates.size(); ++i) {
    const LoopClosureCandidate& candidate = candidates[i];
    result[i] = graphGuess(graph, candidate);
    // Loops that wait for a verdict may connect robots whose poses cannot be compared yet.
    if (graph.shareFrame(candidate.from.robot, candidate.to.robot))
      by_newer[candidate.to].push_back(i);
  }
  for (const auto& [newer, places] : by_newer) {
    std::vector<KeyNodeId> older;
    for (const size_t i : places) older.push_back(candidates[i].from);
    const auto covariances = uncertainty.relativeCovariances(newer, older);
    for (size_t k = 0; k < places.size(); ++k) {
      if (!covariances[k]) continue;
      // (T · Exp(d))⁻¹ = T⁻¹ · Exp(-Ad(T) d), T the pose of the older node seen from the newer.
      Guess& guess = result[places[k]];
      const Matrix6d Ad = adjoint(guess.target_T_source.inverse());
      guess.covariance = Ad * *covariances[k] * Ad.transpose();
    }
  }
  return result;
}

}  // namespace lamp
