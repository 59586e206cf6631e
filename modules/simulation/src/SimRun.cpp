#include "lamp/simulation/SimRun.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "lamp/core/Files.h"
#include "lamp/core/Progress.h"
#include "lamp/core/RunFolder.h"
#include "lamp/simulation/Recording.h"
#include "lamp/simulation/TruthFiles.h"

namespace lamp::simulation {

namespace {

/** The steps of one simulation, in their order. */
class Simulation {
 public:
  Simulation(const SimConfig& config, const SimJob& job)
      : config_(config),
        job_(job),
        world_(makeWorld()),
        caster_(world_.mesh),
        seen_(world_.mesh.triangles.size()),
        mission_(makeMission(config, world_, caster_, mixSeeds({job.seed, 2}))) {}

  std::string run() {
    scanKeyNodes();
    writeRecordings();
    writeTruth();
    return describe();
  }

 private:
  World makeWorld() {
    progress_.show(0, "building the world");
    return config_.kind->make(config_.totalLength(), config_.cellM(), mixSeeds({job_.seed, 1}));
  }

  /** Keyed scans, also of a raw recording: the true pairs are found with them. */
  void scanKeyNodes() {
    constexpr size_t kBatch = 32;
    size_t total = 0, done = 0;
    for (const MissionRobot& robot : mission_.robots) total += robot.key_nodes.size();
    for (const MissionRobot& robot : mission_.robots) {
      scans_.emplace_back(robot.key_nodes.size());
      std::vector<std::vector<Eigen::Vector3f>> moving(robot.key_nodes.size());
      for (size_t begin = 0; begin < robot.key_nodes.size(); begin += kBatch) {
        const size_t end = std::min(begin + kBatch, robot.key_nodes.size());
        tbb::parallel_for(begin, end, [&](size_t i) {
          TrueScan scan = keyedScan(robot, i, config_.keyed, seen_);
          scans_.back()[i] = std::make_shared<const Scan>(std::move(scan.scan));
          moving[i] = std::move(scan.moving);
        });
        done += end - begin;
        progress_.show(
            0.1 + (job_.raw ? 0.1 : 0.6) * static_cast<double>(done) / static_cast<double>(total),
            robot.name + " scans at its key nodes");
      }
      moving_.emplace_back();
      for (size_t i = 0; i < moving.size(); ++i)
        if (!moving[i].empty()) moving_.back()[robot.key_nodes[i]] = std::move(moving[i]);
    }
  }

  void writeRecordings() {
    for (size_t i = 0; i < mission_.robots.size(); ++i) {
      const MissionRobot& robot = mission_.robots[i];
      const std::string stem = job_.out + "/" + robot.name;
      const auto show = [&](double share) {
        const double all =
            (static_cast<double>(i) + share) / static_cast<double>(mission_.robots.size());
        progress_.show(job_.raw ? 0.2 + 0.6 * all : 0.7 + 0.1 * all, robot.name + ".rawlog");
      };
      show(0);
      if (job_.raw) {
        moving_[i].clear();
        writeRawRecording(stem + ".rawlog", robot, mission_, config_, seen_, moving_[i], show);
      } else {
        writeKeyedRecording(stem + ".rawlog", robot, scans_[i], mission_, config_);
      }
      writeTextFile(stem + ".arrivals.csv", arrivalsCsv(robot));
    }
    writeTextFile(job_.out + "/lamp.ini", slamIni(world_, mission_, !job_.raw));
    writeTextFile(job_.out + "/sim.ini", config_.text());
  }

  void writeTruth() {
    const std::string folder = job_.out + "/truth";
    std::filesystem::create_directories(folder);
    for (size_t i = 0; i < mission_.robots.size(); ++i) {
      const MissionRobot& robot = mission_.robots[i];
      writeTextFile(folder + "/" + robot.name + ".tum", truthTum(robot));
      if (mission_.movers)
        writeTextFile(folder + "/" + robot.name + ".movers.ply", moversPly(moving_[i]));
    }
    writeTextFile(folder + "/world.json",
                  worldJson(world_, mission_, config_.kind->name, job_.seed));
    progress_.show(0.8, "pairs of scans");
    pairs_ = findLoopPairs(mission_, world_.layout, scans_,
                           static_cast<size_t>(config_.world.loop_pairs), mixSeeds({job_.seed, 3}));
    writeTextFile(folder + "/loop_pairs.csv", loopPairsCsv(pairs_, mission_));
    progress_.show(0.95, "the true surface");
    samples_ = writeTruthMap(folder + "/map.ply", world_.mesh, seen_, config_.truthSpacingM());
  }

  std::string describe() const {
    std::ostringstream text;
    for (const MissionRobot& robot : mission_.robots) {
      const double minutes = (robot.truth.end() - robot.truth.begin()) / 60;
      text << robot.name << ": " << static_cast<int>(minutes + 0.5) << " min, "
           << robot.key_nodes.size() << " key nodes, odometry's ATE "
           << static_cast<int>(100 * robot.odometry.ate_m + 0.5) / 100.0 << " m\n";
    }
    const auto same = std::count_if(pairs_.begin(), pairs_.end(),
                                    [](const LoopPair& pair) { return pair.same_place; });
    text << "truth: " << samples_ << " samples of the surface, " << same << " true and "
         << static_cast<ptrdiff_t>(pairs_.size()) - same << " false pairs of scans\n"
         << "next: lamp-slam " << job_.out << "/lamp.ini --out RUN\n"
         << "      lamp-eval RUN --truth " << job_.out << "/truth\n";
    return text.str();
  }

  const SimConfig& config_;
  const SimJob& job_;
  Progress progress_;
  const World world_;
  const RayCaster caster_;
  SeenTriangles seen_;
  const Mission mission_;
  std::vector<std::vector<KeyedScanPtr>> scans_;
  std::vector<MovingPoints> moving_;  ///< of each robot
  std::vector<LoopPair> pairs_;
  size_t samples_ = 0;
};

}  // namespace

std::string simulate(const SimConfig& config, const SimJob& job) {
  const RunFolder folder = RunFolder::create(job.out);  // locked to the end
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<size_t>(job.threads));
  tbb::task_arena arena(job.threads);
  return arena.execute([&] { return Simulation(config, job).run(); });
}

}  // namespace lamp::simulation
