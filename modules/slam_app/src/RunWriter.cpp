#include "lamp/slam_app/RunWriter.h"

#include <sys/resource.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "Summary.h"
#include "lamp/base_station/LandmarkTable.h"
#include "lamp/core/Files.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/core/Trajectory.h"
#include "lamp/maps/KeyNodeRawlog.h"
#include "lamp/maps/MapExporter.h"

namespace lamp {

namespace {

using mrpt::system::CTimeLoggerEntry;

void writeTrajectories(const RunFolder& folder, const RunResult& result) {
  const BaseStation& base = result.base_station;
  for (const RobotId robot : base.graph().robots()) {
    const std::string& name = result.robots.name(robot);
    writeTextFile(folder.trajectory(name), toTum(base.tracks().trajectory(base.graph(), robot)));
    writeTextFile(folder.keyNodeTrajectory(name), toTum(keyNodeTrajectory(base.graph(), robot)));
    writeTextFile(folder.odometryTrajectory(name), toTum(base.tracks().odometryTrajectory(robot)));
  }
}

void writeKeyNodes(const RunFolder& folder, const RunResult& result) {
  const BaseStation& base = result.base_station;
  for (const RobotId robot : base.graph().robots()) {
    std::vector<KeyNodePacket> packets;
    for (const KeyNodeId id : base.graph().robotNodes(robot))
      packets.push_back(base.tracks().packets().at(id));
    const std::string& name = result.robots.name(robot);
    writeKeyNodeRawlog(folder.keyNodes(name), name, packets);
  }
}

ComponentMap makeMap(const RunResult& result, const Component& component) {
  const BaseStation& base = result.base_station;
  ComponentMap map;
  map.robots = &result.robots;
  for (const KeyNodeId id : component.nodes) {
    const Node& node = base.graph().node(id);
    map.key_nodes.push_back(
        {id, node.stamp, node.world_T_base, base.tracks().packets().at(id).scan});
  }
  for (const RobotId robot : component.robots)
    map.tracks.push_back({robot, base.tracks().trajectory(base.graph(), robot)});
  for (const Edge& edge : base.graph().edges()) {
    if (edge.type != EdgeType::kLoopClosure) continue;
    const auto inside = [&](KeyNodeId id) {
      return std::binary_search(component.nodes.begin(), component.nodes.end(), id);
    };
    if (inside(edge.from) && inside(edge.to))
      map.loops.push_back({base.graph().node(edge.from).world_T_base.translation(),
                           base.graph().node(edge.to).world_T_base.translation(), edge.verdict});
  }
  return map;
}

void writeMaps(const RunFolder& folder, const RunResult& result, mrpt::system::CTimeLogger& timer,
               const WriteProgress& progress) {
  const auto components = result.base_station.graph().components();
  const auto exporters = result.config.make<MapExporter>();
  size_t written = 0;
  for (size_t rank = 0; rank < components.size(); ++rank) {
    const ComponentMap map = makeMap(result, components[rank]);
    for (const auto& exporter : exporters) {
      progress(static_cast<double>(written++) / (components.size() * exporters.size()),
               "writing map " + std::to_string(rank + 1) + " of " +
                   std::to_string(components.size()) + ": " + exporter->getLoggerName());
      const CTimeLoggerEntry timing(timer, ("maps." + exporter->getLoggerName()).c_str());
      exporter->exportMap(map, folder.mapStem(rank));
    }
  }
}

std::string names(const RobotTable& robots, const std::vector<RobotId>& ids) {
  std::string text;
  for (const RobotId robot : ids) text += (text.empty() ? "" : ", ") + robots.name(robot);
  return text;
}

}  // namespace

void writeRun(const RunFolder& folder, const RunResult& result, mrpt::system::CTimeLogger& timer,
              const WriteProgress& progress) {
  const BaseStation& base = result.base_station;
  folder.createSubfolders();
  {
    const CTimeLoggerEntry timing(timer, "run_folder");
    writeTextFile(folder.config(), result.config.text());
    writeTrajectories(folder, result);
    writeTextFile(folder.graphG2o(), toG2o(base.graph()));
    writeTextFile(folder.graphMrpt(), toMrptGraph(base.graph()));
    writeTextFile(folder.graphIds(), toGraphIdsCsv(base.graph(), result.robots));
    writeTextFile(folder.loops(), base.ledger().loops(base.graph(), result.robots).text());
    writeTextFile(folder.verdicts(), base.ledger().verdicts().text());
    writeTextFile(folder.actions(), toCsv(base.actions()).text());
    if (!base.graph().landmarks().empty())
      writeTextFile(folder.artifacts(), landmarkTable(base.graph(), result.robots).text());
    writeKeyNodes(folder, result);
  }
  writeMaps(folder, result, timer, progress);
  writeTextFile(folder.summary(), summarize(result).dump(2) + "\n");
}

void writeTimings(const RunFolder& folder, const mrpt::system::CTimeLogger& timer,
                  const PreparationReport& preparation, int threads) {
  std::map<std::string, mrpt::system::CTimeLogger::TCallStats> stats;
  timer.getStats(stats);
  nlohmann::ordered_json json;
  json["threads"] = threads;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  json["peak_memory_mb"] = static_cast<double>(usage.ru_maxrss) / 1024.0;
  for (const auto& [name, stat] : stats)
    json["stages"][name] = {{"seconds", stat.total_t}, {"calls", stat.n_calls}};
  // Within registration, on all threads: the calls are key nodes' scans.
  json["stages"]["registration.prepare"] = {{"seconds", preparation.seconds},
                                            {"calls", preparation.scans}};
  writeTextFile(folder.timings(), json.dump(2) + "\n");
}

std::string describeRun(const RunFolder& folder, const RunResult& result) {
  const BaseStation& base = result.base_station;
  const LoopCounts loops = countLoops(base);
  const auto components = base.graph().components();
  std::ostringstream text;
  text << base.graph().nodes().size() << " key nodes, " << loops.attempts
       << " loop closures tried, " << loops.verified << " verified, " << loops.inliers << " kept\n";
  for (size_t rank = 0; rank < components.size(); ++rank) {
    const ComponentLoops inliers = countLoops(base.graph(), components[rank]);
    text << "map " << rank + 1 << " of " << components.size() << ": "
         << names(result.robots, components[rank].robots) << " (" << components[rank].nodes.size()
         << " key nodes, " << inliers.within_robots << " loops within robots, "
         << inliers.between_robots << " between): " << folder.mapStem(rank) << ".*\n";
  }
  if (const MeasurementCounts counts = countMeasurements(base.graph()); counts.edges > 0)
    text << "beside lidar and odometry: " << counts.edges << " measurements of gravity, "
         << base.graph().landmarks().size() << " landmarks and distances, " << counts.inliers
         << " kept\n";
  if (components.size() > 1)
    text << "No trusted loop closure joins these " << components.size()
         << " components: they stay separate maps.\n";
  if (const double scale = base.lastReport().odometry_scale; scale > 1.0)
    text << "The loop closures say that odometry is worse than stated: its covariances were taken "
         << scale << " times larger.\n";
  for (const FrameAgreement& frames : base.lastReport().frames)
    if (!frames.joined)
      text << result.robots.name(frames.a) << " and " << result.robots.name(frames.b) << ": of "
           << frames.loops << " loop closures between them " << frames.agreeing
           << " agree, each with key nodes of its own; " << frames.needed << " are needed.\n";
  if (result.interrupted) text << "The run was interrupted: this is the map up to there.\n";
  return text.str();
}

}  // namespace lamp
