#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "LampProcess.h"
#include "RecordingTools.h"
#include "SyntheticRobot.h"
#include "TemporaryFolder.h"
#include "lamp/core/Csv.h"
#include "lamp/core/RunFolder.h"

namespace lamp::test {

/** What a run left in its folder. */
class FinishedRun {
 public:
  explicit FinishedRun(const std::string& root) : folder_(root) {}

  const RunFolder& folder() const { return folder_; }
  nlohmann::json summary() const;
  CsvTable loops() const { return CsvTable::fromFile(folder_.loops()); }
  std::vector<StampedPose> trajectory(const std::string& robot) const;
  std::vector<StampedPose> odometry(const std::string& robot) const;
  std::vector<StampedPose> keyNodes(const std::string& robot) const;
  /** Where `b` started, seen from the start of `a`. */
  Pose3 startOf(const std::string& b, const std::string& a) const;
  bool has(const std::string& file) const;
  /** Content of all files by relative path, but of timings.json. */
  std::map<std::string, std::string> files() const;

 private:
  RunFolder folder_;
};

/** Fails the test for each file that differs, timings.json apart. */
void expectSameFiles(const FinishedRun& one, const FinishedRun& two);

/** The ends of an accepted loop closure, `robot:index`. */
using LoopEnds = std::pair<std::string, std::string>;
std::vector<LoopEnds> inlierLoops(const CsvTable& loops);
std::string robotOf(const std::string& key_node);
int indexOf(const std::string& key_node);

/** Recordings, an ini and runs of lamp-slam in a folder of their own. */
class Experiment {
 public:
  /** Writes `name` as an uncompressed rawlog. \return its path. */
  std::string rawlog(const std::string& name, const Objects& objects) const;
  std::string file(const std::string& name, const std::string& content) const;
  std::string path(const std::string& name) const { return folder_ / name; }

  /** Runs lamp-slam with `--out` at the folder `name`. */
  LampResult run(const std::vector<std::string>& arguments, const std::string& name = "run") const;
  FinishedRun result(const std::string& name = "run") const { return FinishedRun(folder_ / name); }

 private:
  TemporaryFolder folder_;
};

/** An ini for the worlds of BoxWorld, with `more` at the end; no maps unless `exporters` says so.
 */
std::string iniFor3d(const std::string& exporters = "", const std::string& more = "");
std::string iniForPlanar(const std::string& exporters = "");
/** A `[robot.NAME]` section with a start pose. */
std::string startSection(const std::string& robot, const Pose3& world_T_base);

}  // namespace lamp::test
