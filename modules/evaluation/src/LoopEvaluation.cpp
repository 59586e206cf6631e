#include "lamp/evaluation/LoopEvaluation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "lamp/core/ScanOverlap.h"
#include "lamp/evaluation/KeyedScans.h"

namespace lamp::evaluation {

namespace {

/** What is known of a key node that takes part in a loop. */
struct TrueNode {
  std::optional<Pose3> world_T_base;
  std::unique_ptr<const OverlapScan> scan;  ///< null if there is none
};
using TrueNodes = std::map<uint32_t, TrueNode>;  ///< by graph id

std::vector<LedgerNode> nodesOf(const std::string& robot, const std::vector<LedgerLoop>& loops) {
  std::map<uint32_t, LedgerNode> nodes;
  for (const LedgerLoop& loop : loops)
    for (const LedgerNode* node : {&loop.from, &loop.to})
      if (node->robot == robot) nodes[node->graph_id] = *node;
  std::vector<LedgerNode> result;
  for (const auto& [id, node] : nodes) result.push_back(node);
  return result;
}

void addScans(const std::vector<LedgerNode>& nodes, const std::string& path, bool planar,
              TrueNodes& all, std::vector<std::string>& warnings) {
  if (!std::filesystem::exists(path)) {
    warnings.push_back("there is no '" + path + "': which of its pairs are true is unknown");
    return;
  }
  const KeyedScans scans = readKeyedScans(path);
  if (!scans.damage.empty()) warnings.push_back(scans.damage);
  std::vector<std::unique_ptr<const OverlapScan>> prepared(nodes.size());
  tbb::parallel_for(size_t{0}, nodes.size(), [&](size_t i) {
    if (const auto* points = scans.at(nodes[i].stamp))
      prepared[i] = std::make_unique<OverlapScan>(*points, planar);
  });
  for (size_t i = 0; i < nodes.size(); ++i) all[nodes[i].graph_id].scan = std::move(prepared[i]);
}

TrueNodes trueNodes(const RunFiles& run, const TruthFolder& truth,
                    const std::vector<LedgerLoop>& loops, std::vector<std::string>& warnings) {
  TrueNodes all;
  for (const RunFiles::Robot& robot : run.robots) {
    if (!truth.has(robot.name)) continue;
    const std::vector<LedgerNode> nodes = nodesOf(robot.name, loops);
    const TrueTrajectory path(readTum(truth.trajectory(robot.name)), robot.planar);
    for (const LedgerNode& node : nodes) all[node.graph_id].world_T_base = path.at(node.stamp);
    addScans(nodes, run.folder.keyNodes(robot.name), robot.planar, all, warnings);
  }
  return all;
}

JudgedLoop judge(const LedgerLoop& loop, const TrueNodes& nodes) {
  JudgedLoop judged;
  judged.loop = loop;
  const auto from = nodes.find(loop.from.graph_id), to = nodes.find(loop.to.graph_id);
  if (from == nodes.end() || to == nodes.end() || !from->second.world_T_base ||
      !to->second.world_T_base)
    return judged;
  const Pose3 from_T_to = from->second.world_T_base->inverse() * *to->second.world_T_base;
  if (loop.has_result) {
    judged.error = from_T_to.inverse() * loop.from_T_to;
    judged.closure = closureKind(*judged.error, loop.information);
  }
  if (from->second.scan && to->second.scan)
    judged.pair = pairKind(scanOverlap(*from->second.scan, *to->second.scan, from_T_to));
  return judged;
}

LoopScore scoreIf(const std::vector<JudgedLoop>& loops, bool (*in)(const LedgerLoop&)) {
  std::vector<const JudgedLoop*> selected;
  for (const JudgedLoop& judged : loops)
    if (in(judged.loop)) selected.push_back(&judged);
  return scoreLoops(selected);
}

}  // namespace

LoopEvaluation evaluateLoops(const RunFiles& run, const TruthFolder& truth) {
  LoopEvaluation evaluation;
  const std::vector<LedgerLoop> loops = readLedger(run.folder);
  const TrueNodes nodes = trueNodes(run, truth, loops, evaluation.warnings);
  evaluation.loops.resize(loops.size());
  tbb::parallel_for(size_t{0}, loops.size(),
                    [&](size_t i) { evaluation.loops[i] = judge(loops[i], nodes); });
  evaluation.all = scoreIf(evaluation.loops, [](const LedgerLoop&) { return true; });
  evaluation.within_robots =
      scoreIf(evaluation.loops, [](const LedgerLoop& loop) { return !loop.betweenRobots(); });
  evaluation.between_robots =
      scoreIf(evaluation.loops, [](const LedgerLoop& loop) { return loop.betweenRobots(); });
  return evaluation;
}

}  // namespace lamp::evaluation
