#include "lamp/evaluation/RunEvaluation.h"

#include <stdexcept>

namespace lamp {

namespace {

RelationEvaluation evaluateRelations(const RunFiles& run, const EvaluationInput& input) {
  if (run.robots.size() != 1)
    throw std::runtime_error("--relations are of one robot, '" + run.folder.root() + "' has " +
                             std::to_string(run.robots.size()));
  const std::string& robot = run.robots.front().name;
  const auto relations = readRelations(input.relations);
  const auto errors = [&](const std::string& path) {
    return relationErrors(withRelationStamps(readTum(path), input.scan_stamps), relations);
  };
  return {errors(run.folder.trajectory(robot)), errors(run.folder.odometryTrajectory(robot))};
}

}  // namespace

RunEvaluation evaluateRun(const std::string& root, const EvaluationInput& input) {
  RunEvaluation evaluation;
  evaluation.run = RunFiles::open(root);
  if (evaluation.run.interrupted)
    evaluation.notes.push_back("the run was interrupted: its results end early");
  if (input.truth) {
    evaluation.trajectories = evaluateTrajectories(evaluation.run, *input.truth, input.alignment);
    const auto& warnings = evaluation.trajectories->warnings;
    evaluation.notes.insert(evaluation.notes.end(), warnings.begin(), warnings.end());
  }
  if (!input.relations.empty()) evaluation.relations = evaluateRelations(evaluation.run, input);
  return evaluation;
}

}  // namespace lamp
