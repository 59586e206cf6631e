#include "lamp/slam_app/RunWriter.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <map>
#include <new>
#include <sstream>

#include "Summary.h"
#include "WorldFrame.h"
#include "lamp/base_station/LandmarkTable.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/GraphFiles.h"
#include "lamp/core/Trajectory.h"
#include "lamp/maps/KeyNodeRawlog.h"
#include "lamp/maps/MapExporter.h"

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

void writeMaps(const RunFolder& folder, const RunResult& result, mrpt::system::CTimeLogger& timer,
               const WriteProgress& progress, Steps& steps) {
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
      steps.take(exporter->getLoggerName(),
                 [&] { exporter->exportMap(map, folder.mapStem(rank)); });
    }
  }
}

std::string names(const RobotTable& robots, const std::vector<RobotId>& ids) {
  std::string text;
  for (const RobotId robot : ids) text += (text.empty() ? "" : ", ") + robots.name(robot);
  return text;
}

/** Placements to name before "and so many more". */
constexpr size_t kNamedPlacements = 4;

/** One decimal, and no minus before zero. */
std::string rounded(double value) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << std::round(value * 10) / 10 + 0.0;
  return text.str();
}

std::string describePlacements(const std::vector<Pose3>& placements) {
  std::string text;
  for (size_t k = 0; k < std::min(kNamedPlacements, placements.size()); ++k) {
    const Vector6d pose = yawPitchRollFromPose(placements[k]);
    text += (k == 0 ? "(" : ", (") + rounded(pose[0]) + " " + rounded(pose[1]) + " " +
            rounded(pose[2]) + ", " + rounded(pose[3] * 180.0 / M_PI) + ")";
  }
  if (placements.size() > kNamedPlacements)
    text += " and " + std::to_string(placements.size() - kNamedPlacements) + " more";
  return text;
}

/** Why two robots stay apart. */
std::string describeFrames(const FrameAgreement& frames, const RobotTable& robots) {
  const std::string a = robots.name(frames.a), b = robots.name(frames.b);
  if (frames.contradicting > 0) {
    const auto percent = std::to_string(std::lround(100 * frames.contradicting));
    return a + " and " + b + ": " + std::to_string(frames.agreeing) +
           " loop closures between them agree on a placement that " + percent +
           " % of what can be compared contradicts: one has seen it where the other saw through.";
  }
  if (frames.equally_good.empty())
    return a + " and " + b + ": of " + std::to_string(frames.loops) +
           " loop closures between them " + std::to_string(frames.agreeing) +
           " agree, each between different key nodes; " + std::to_string(frames.needed) +
           " are needed.";
  return a + " and " + b + " see places that look alike: these placements of " + b +
         "'s first key node, seen from " + a +
         "'s (x y z in metres, yaw in degrees), are equally good: " +
         describePlacements(frames.equally_good) +
         ". They stay apart; a start pose or a place that both have seen and that is like no other "
         "would tell.";
}

}  // namespace

std::vector<std::string> writeRun(const RunFolder& folder, const RunResult& result,
                                  mrpt::system::CTimeLogger& timer, const WriteProgress& progress) {
  folder.createSubfolders();
  Steps steps;
  {
    const CTimeLoggerEntry timing(timer, "run_folder");
    const PoseGraph world = inWorldFrame(result.base_station.graph(), result.world_p_origin);
    writeTables(folder, result, world, steps);
    writeTrajectories(folder, result, world, steps);
    writeKeyNodes(folder, result, steps);
  }
  writeMaps(folder, result, timer, progress, steps);
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
    text << "other sensors: " << counts.edges << " measurements of gravity, "
         << base.graph().landmarks().size() << " landmarks and distances, " << counts.inliers
         << " kept\n";
  if (components.size() > 1)
    text << "No trusted loop closure joins these " << components.size()
         << " components: they stay separate maps.\n";
  if (const double scale = base.lastReport().odometry_scale; scale > 1.0)
    text << "The loop closures show that odometry is worse than its covariances state: they were "
            "scaled up "
         << scale << " times larger.\n";
  for (const FrameAgreement& frames : base.lastReport().frames)
    if (!frames.joined) text << describeFrames(frames, result.robots) << "\n";
  if (!result.world_p_origin.isZero(0)) {
    text
        << "The maps are in a frame of their own near the robots: their files and summary.json say "
           "what to add for world coordinates:";
    for (const double coordinate : result.world_p_origin) text << " " << formatFixed(coordinate, 0);
    text << " m\n";
  }
  if (result.interrupted) text << "The run was interrupted: this is the map up to that point.\n";
  return text.str();
}

}  // namespace lamp
