#include "ReportJson.h"

#include "lamp/core/Version.h"

namespace lamp {

namespace {

using Json = nlohmann::ordered_json;

Json optionalNumber(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

double share(size_t part, size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

Json driftJson(const Drift& drift) {
  return {{"translation_percent", optionalNumber(drift.meanTranslation())},
          {"rotation_deg_per_m", optionalNumber(drift.meanRotation())},
          {"segments", drift.translation_percent.size()}};
}

Json scoreJson(const TrajectoryScore& score) {
  const Statistics position = Statistics::of(score.error.position_m);
  const Statistics rotation = Statistics::of(score.error.rotation_deg);
  return {{"ate_mean_m", position.mean},
          {"ate_rmse_m", position.rmse},
          {"ate_max_m", position.max},
          {"rotation_mean_deg", rotation.mean},
          {"rotation_max_deg", rotation.max},
          {"drift_10m", driftJson(score.drift_10m)},
          {"drift_100m", driftJson(score.drift_100m)},
          {"scans", score.estimated},
          {"scans_joined", score.joined},
          {"scans_joined_share", share(score.joined, score.estimated)},
          {"truth_covered_share", share(score.true_poses_met, score.true_poses)}};
}

/** Null if there is no odometry to score. */
Json bothJson(const TrajectoryScore& result, const TrajectoryScore& odometry) {
  return {{"result", scoreJson(result)},
          {"odometry", odometry.joined > 0 ? scoreJson(odometry) : Json(nullptr)}};
}

Json trajectoriesJson(const TrajectoryEvaluation& evaluation) {
  Json json;
  json["all"] = bothJson(evaluation.result, evaluation.odometry);
  for (const RobotEvaluation& robot : evaluation.robots) {
    json["robots"][robot.name] = bothJson(robot.result, robot.odometry);
    json["robots"][robot.name]["component"] = robot.component + 1;
    json["robots"][robot.name]["planar"] = robot.planar;
  }
  return json;
}

Json relationErrorJson(const RelationError& error) {
  if (error.translation_m.count == 0) return nullptr;
  return {{"relations", error.translation_m.count},
          {"translation_mean_m", error.translation_m.mean},
          {"translation_std_m", error.translation_m.std},
          {"rotation_mean_deg", error.rotation_deg.mean},
          {"rotation_std_deg", error.rotation_deg.std}};
}

Json relationErrorsJson(const RelationErrors& errors) {
  return {{"all", relationErrorJson(errors.all)},
          {"below_5_s", relationErrorJson(errors.below_5_s)},
          {"from_5_s", relationErrorJson(errors.from_5_s)},
          {"without_pose", errors.without_pose}};
}

Json runJson(const RunEvaluation& run) {
  Json json;
  json["name"] = run.name;
  json["folder"] = run.run.folder.root();
  json["interrupted"] = run.run.interrupted;
  json["notes"] = run.notes;
  if (run.trajectories) json["trajectories"] = trajectoriesJson(*run.trajectories);
  if (run.relations)
    json["relations"] = {{"result", relationErrorsJson(run.relations->result)},
                         {"odometry", relationErrorsJson(run.relations->odometry)}};
  return json;
}

}  // namespace

Json reportJson(const std::vector<RunEvaluation>& runs, const EvaluationInput& input) {
  Json json;
  json["program"] = std::string("lamp-eval ") + kVersion;
  if (input.truth) {
    json["truth"] = input.truth->root();
    json["alignment"] = toString(input.alignment);
    json["alignment_meaning"] = describe(input.alignment);
  }
  json["runs"] = Json::array();
  for (const RunEvaluation& run : runs) json["runs"].push_back(runJson(run));
  return json;
}

}  // namespace lamp
