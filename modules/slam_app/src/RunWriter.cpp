#include "lamp/slam_app/RunWriter.h"

#include <sys/resource.h>

#include <algorithm>
#include <functional>
#include <map>
#include <new>

#include "Summary.h"
#include "WorldFrame.h"
#include "lamp/base_station/LandmarkTable.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/core/Trajectory.h"
#include "lamp/maps/KeyNodeRawlog.h"

namespace lamp {

namespace {

using mrpt::system::CTimeLoggerEntry;

/** Steps that each write something; one that fails does not keep the next from being done. */
class Steps {
 public:
  void take(const std::string& name, const std::function<void()>& write) {
    try {
      write();
    } catch (const std::bad_alloc&) {
      failures_.push_back(name + ": not enough memory");
    } catch (const std::exception& error) {
      failures_.push_back(name + ": " + error.what());
    }
  }
  const std::vector<std::string>& failures() const { return failures_; }

 private:
  std::vector<std::string> failures_;
};

/** From the start pose, which is zero for robots that have none. */
std::vector<StampedPose> odometryInWorld(const RunResult& result, RobotId robot) {
  const RobotTracks& tracks = result.base_station.tracks();
  auto trajectory = tracks.odometryTrajectory(robot);
  if (tracks.packets().lower_bound({robot, 0})->second.prior)
    for (StampedPose& pose : trajectory) pose.pose.pretranslate(result.world_p_origin);
  return trajectory;
}

void writeTrajectories(const RunFolder& folder, const RunResult& result, const PoseGraph& world,
                       Steps& steps) {
  const RobotTracks& tracks = result.base_station.tracks();
  for (const RobotId robot : world.robots()) {
    const std::string& name = result.robots.name(robot);
    const auto write = [&](const std::string& path, const std::vector<StampedPose>& trajectory) {
      steps.take("trajectories", [&] { writeTextFile(path, toTum(trajectory)); });
    };
    write(folder.trajectory(name), tracks.trajectory(world, robot));
    write(folder.keyNodeTrajectory(name), keyNodeTrajectory(world, robot));
    write(folder.odometryTrajectory(name), odometryInWorld(result, robot));
  }
}

void writeKeyNodes(const RunFolder& folder, const RunResult& result, Steps& steps) {
  const BaseStation& base = result.base_station;
  for (const RobotId robot : base.graph().robots()) {
    std::vector<KeyNodePacket> packets;
    for (const KeyNodeId id : base.graph().robotNodes(robot))
      packets.push_back(base.tracks().packets().at(id));
    const std::string& name = result.robots.name(robot);
    steps.take("keyed scans", [&] { writeKeyNodeRawlog(folder.keyNodes(name), name, packets); });
  }
}

void writeTables(const RunFolder& folder, const RunResult& result, const PoseGraph& world,
                 Steps& steps) {
  const BaseStation& base = result.base_station;
  const auto write = [&](const std::string& path, const std::function<std::string()>& text) {
    steps.take("tables", [&] { writeTextFile(path, text()); });
  };
  write(folder.config(), [&] { return result.config.text(); });
  write(folder.graphG2o(), [&] { return toG2o(world); });
  write(folder.graphMrpt(), [&] { return toMrptGraph(world); });
  write(folder.graphIds(), [&] { return toGraphIdsCsv(world, result.robots); });
  write(folder.loops(), [&] { return base.ledger().loops(base.graph(), result.robots).text(); });
  write(folder.verdicts(), [&] { return base.ledger().verdicts().text(); });
  write(folder.actions(), [&] { return toCsv(base.actions()).text(); });
  if (!world.landmarks().empty())
    write(folder.artifacts(), [&] { return landmarkTable(world, result.robots).text(); });
}

ComponentMap makeMap(const RunResult& result, const Component& component) {
  const BaseStation& base = result.base_station;
  ComponentMap map;
  map.robots = &result.robots;
  map.world_p_origin = originOf(component, base.graph(), result.world_p_origin);
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

void writeMaps(const RunFolder& folder, const RunResult& result, const MapExporters& exporters,
               const std::vector<Component>& components, mrpt::system::CTimeLogger& timer,
               const WriteProgress& progress, Steps& steps) {
  size_t written = 0;
  for (size_t rank = 0; rank < components.size(); ++rank) {
    ComponentMap map = makeMap(result, components[rank]);
    map.occupancy = exporters.occupancy;
    for (const auto& exporter : exporters.stages) {
      progress(static_cast<double>(written++) / (components.size() * exporters.stages.size()),
               "writing map " + std::to_string(rank + 1) + " of " +
                   std::to_string(components.size()) + ": " + exporter->getLoggerName());
      const CTimeLoggerEntry timing(timer, ("maps." + exporter->getLoggerName()).c_str());
      steps.take(exporter->getLoggerName(),
                 [&] { exporter->exportMap(map, folder.mapStem(rank)); });
    }
  }
}

}  // namespace

std::vector<std::string> writeMapSoFar(const RunFolder& folder, const RunResult& result,
                                       const MapExporters& exporters,
                                       mrpt::system::CTimeLogger& timer) {
  folder.createSubfolders();
  auto components = result.base_station.graph().components();
  components.resize(std::min<size_t>(components.size(), 1));
  Steps steps;
  writeMaps(
      folder, result, exporters, components, timer, [](double, const std::string&) {}, steps);
  return steps.failures();
}

std::vector<std::string> writeRun(const RunFolder& folder, const RunResult& result,
                                  const MapExporters& exporters, mrpt::system::CTimeLogger& timer,
                                  const WriteProgress& progress) {
  folder.createSubfolders();
  Steps steps;
  {
    const CTimeLoggerEntry timing(timer, "run_folder");
    const PoseGraph world = inWorldFrame(result.base_station.graph(), result.world_p_origin);
    writeTables(folder, result, world, steps);
    writeTrajectories(folder, result, world, steps);
    writeKeyNodes(folder, result, steps);
  }
  writeMaps(folder, result, exporters, result.base_station.graph().components(), timer, progress,
            steps);
  steps.take("summary", [&] {
    writeTextFile(folder.summary(), summarize(result, steps.failures()).dump(2) + "\n");
  });
  return steps.failures();
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

}  // namespace lamp
