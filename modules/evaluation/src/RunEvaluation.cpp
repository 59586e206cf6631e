#include "lamp/evaluation/RunEvaluation.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace lamp::evaluation {

namespace {

namespace fs = std::filesystem;

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

void append(const std::vector<std::string>& more, std::vector<std::string>& notes) {
  notes.insert(notes.end(), more.begin(), more.end());
}

void addLoops(const TruthFolder& truth, RunEvaluation& evaluation) {
  if (!fs::exists(evaluation.run.folder.loops())) {
    evaluation.notes.push_back("no loops.csv: loop closures are not scored");
    return;
  }
  evaluation.loops = evaluateLoops(evaluation.run, truth);
  append(evaluation.loops->warnings, evaluation.notes);
}

/** `truth_T_world` of a component; none, with a note, where the alignment leaves none. A planar map
 * lies at height zero and is lifted to the mean height of its robots. */
std::optional<Pose3> worldAlignment(size_t component, RunEvaluation& evaluation) {
  const RunFiles::Component& members = evaluation.run.components[component];
  const std::string name = "map " + std::to_string(component + 1);
  const TrajectoryEvaluation& trajectories = *evaluation.trajectories;
  if (trajectories.alignment == Alignment::kSe3 && members.robots.size() > 1) {
    evaluation.notes.push_back(name + " is not scored: alignment 'se3' moves its robots apart");
    return std::nullopt;
  }
  for (const RobotEvaluation& robot : trajectories.robots) {
    if (robot.component != component) continue;
    const Pose3 lift(Eigen::Translation3d(0, 0, robot.planar ? robot.mean_true_height_m : 0.0));
    return lift * robot.truth_T_world;
  }
  evaluation.notes.push_back(name + " is not scored: none of its robots has a true trajectory");
  return std::nullopt;
}

void addOctoMap(const std::string& stem, const Pose3& surface_T_world, const TrueWorld& world,
                const std::vector<Eigen::Vector3f>& moving, RunEvaluation& evaluation) {
  for (const char* extension : {".bt", ".ot"}) {
    if (!fs::exists(stem + extension)) continue;
    evaluation.octomap = evaluateOctoMap(stem + extension, surface_T_world, world.surface.samples(),
                                         world.positions, moving);
    if (!evaluation.octomap->no_free_space.empty())
      evaluation.notes.push_back("free space is not scored: " + evaluation.octomap->no_free_space);
    return;
  }
}

void addMaps(const TruthFolder& truth, const TrueWorld& world, RunEvaluation& evaluation) {
  for (size_t i = 0; i < evaluation.run.components.size(); ++i) {
    const std::string& stem = evaluation.run.components[i].map;
    const bool has_cloud = !stem.empty() && fs::exists(stem + ".ply");
    if (i > 0 && !has_cloud) continue;
    const auto truth_T_world = worldAlignment(i, evaluation);
    if (!truth_T_world) continue;
    const SurfaceSamples& samples = world.surface.samples();
    const Pose3 surface_T_world = Eigen::Translation3d(-samples.world_p_origin) * *truth_T_world;
    if (has_cloud)
      evaluation.maps.push_back(evaluateMap(stem + ".ply", surface_T_world, world.surface));
    else
      evaluation.notes.push_back("no " + stem + ".ply: the point cloud is not scored");
    if (i > 0) continue;
    const ScannedPoints scanned =
        scannedPoints(evaluation.run, i, truth, surface_T_world, world.surface);
    append(scanned.notes, evaluation.notes);
    if (has_cloud)
      evaluation.maps.back().removal = evaluateRemoval(scanned, evaluation.maps.back().points);
    addOctoMap(stem, surface_T_world, world, scanned.moving, evaluation);
  }
}

}  // namespace

std::shared_ptr<const TrueWorld> TrueWorld::open(const TruthFolder& truth) {
  if (!fs::exists(truth.map())) return nullptr;
  SurfaceSamples samples = SurfaceSamples::fromPly(truth.map());
  std::vector<Eigen::Vector3f> positions;
  for (const std::string& robot : truth.robots())
    for (const StampedPose& pose : readTum(truth.trajectory(robot)))
      positions.push_back((pose.pose.translation() - samples.world_p_origin).cast<float>());
  return std::shared_ptr<const TrueWorld>(
      new TrueWorld{TrueSurface(std::move(samples)), std::move(positions)});
}

RunEvaluation evaluateRun(const std::string& root, const EvaluationInput& input,
                          const std::function<void(double, const std::string&)>& progress) {
  RunEvaluation evaluation;
  evaluation.run = RunFiles::open(root);
  if (evaluation.run.interrupted)
    evaluation.notes.push_back("the run was interrupted: its results are incomplete");
  if (input.truth) {
    progress(0.0, "trajectories");
    evaluation.trajectories = evaluateTrajectories(evaluation.run, *input.truth, input.alignment);
    append(evaluation.trajectories->warnings, evaluation.notes);
    progress(0.1, "loop closures");
    if (fs::exists(evaluation.run.folder.graphG2o()) &&
        fs::exists(evaluation.run.folder.graphIds()))
      evaluation.odometry_edges = evaluateOdometryEdges(evaluation.run, *input.truth);
    addLoops(*input.truth, evaluation);
    progress(0.5, "maps");
    if (input.world)
      addMaps(*input.truth, *input.world, evaluation);
    else
      evaluation.notes.push_back("the truth has no map.ply: maps are not scored");
  }
  if (!input.relations.empty()) evaluation.relations = evaluateRelations(evaluation.run, input);
  return evaluation;
}

}  // namespace lamp::evaluation
