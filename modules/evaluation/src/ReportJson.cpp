#include "ReportJson.h"

#include "lamp/core/Version.h"

namespace lamp::evaluation {

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

Json stageJson(const LoopScore& score, const StageScore& stage) {
  return {{"accepted", stage.accepted},
          {"right", stage.right},
          {"wrong", stage.wrong},
          {"neither", stage.neither},
          {"not_judged", stage.not_judged},
          {"true_pairs", stage.true_pairs},
          {"false_pairs", stage.false_pairs},
          {"between_pairs", stage.between_pairs},
          {"unknown_pairs", stage.unknown_pairs},
          {"precision", optionalNumber(LoopScore::precision(stage))},
          {"recall", optionalNumber(score.recall(stage))},
          {"recall_of_pairs", optionalNumber(score.recallOfPairs(stage))},
          {"false_positives", optionalNumber(score.falsePositives(stage))}};
}

Json errorJson(const Statistics& error, const std::string& unit) {
  if (error.count == 0) return nullptr;
  return {
      {"mean_" + unit, error.mean}, {"median_" + unit, error.median}, {"max_" + unit, error.max}};
}

Json covarianceJson(const CovarianceScore& score) {
  if (score.count == 0) return nullptr;
  Json json = {{"edges", score.count}, {"beyond_95_share", score.beyond_95}};
  const char* const axes[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  for (size_t i = 0; i < 6; ++i)
    json["normalized_variance"][axes[i]] = optionalNumber(score.normalized_variance[i]);
  return json;
}

Json loopScoreJson(const LoopScore& score) {
  return {{"generated", stageJson(score, score.generated)},
          {"verified", stageJson(score, score.verified)},
          {"kept", stageJson(score, score.kept)},
          {"kept_translation_error", errorJson(score.translation_m, "m")},
          {"kept_rotation_error", errorJson(score.rotation_deg, "deg")},
          {"covariance", covarianceJson(score.covariance)}};
}

/** \param part of the points, which the measure names. */
Json pointsJson(const char* measure, size_t part, const PointsKept& points) {
  return {{measure, points.points > 0 ? Json(share(part, points.points)) : Json(nullptr)},
          {"points", points.points},
          {"kept", points.kept}};
}

Json mapsJson(const std::vector<MapEvaluation>& maps) {
  Json json;
  for (const MapEvaluation& map : maps) {
    json[map.name] = {{"points", map.points.size()},
                      {"accuracy_mean_m", map.accuracy_m.mean},
                      {"accuracy_p95_m", map.accuracy_m.p95},
                      {"accuracy_max_m", map.accuracy_m.max},
                      {"completeness_share", map.completeness}};
    if (!map.removal) continue;
    const auto& [moving, fixed, stray] = *map.removal;
    json[map.name]["moving"] = pointsJson("kept_share", moving.kept, moving);
    json[map.name]["surface"] = pointsJson("removed_share", fixed.points - fixed.kept, fixed);
    json[map.name]["stray"] = pointsJson("kept_share", stray.kept, stray);
  }
  return json;
}

/** The share that was marked wrongly (or rightly), with the counts behind it. */
Json countsJson(const char* measure, size_t part, const OctoMapCounts& counts) {
  return {{measure, counts.total() > 0 ? Json(share(part, counts.total())) : Json(nullptr)},
          {"places", counts.total()},
          {"occupied", counts.occupied},
          {"free", counts.free},
          {"unknown", counts.unknown}};
}

Json octomapJson(const OctoMapEvaluation& e) {
  return {{"resolution_m", e.resolution_m},
          {"free_space_resolution_m", e.free_resolution_m},
          {"surface", countsJson("marked_free_share", e.surface.free, e.surface)},
          {"free_space", countsJson("marked_occupied_share", e.free_space.occupied, e.free_space)},
          {"driven_floor", countsJson("known_share", e.driven_floor.occupied + e.driven_floor.free,
                                      e.driven_floor)},
          {"moving", countsJson("marked_occupied_share", e.moving.occupied, e.moving)}};
}

Json runJson(const RunEvaluation& run) {
  Json json;
  json["name"] = run.name;
  json["folder"] = run.run.folder.root();
  json["interrupted"] = run.run.interrupted;
  json["notes"] = run.notes;
  if (run.trajectories) json["trajectories"] = trajectoriesJson(*run.trajectories);
  if (run.odometry_edges) json["odometry_edges"] = covarianceJson(*run.odometry_edges);
  if (run.loops)
    json["loops"] = {{"all", loopScoreJson(run.loops->all)},
                     {"within_robots", loopScoreJson(run.loops->within_robots)},
                     {"between_robots", loopScoreJson(run.loops->between_robots)}};
  if (!run.maps.empty()) json["maps"] = mapsJson(run.maps);
  if (run.octomap) json["octomap"] = octomapJson(*run.octomap);
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

}  // namespace lamp::evaluation
