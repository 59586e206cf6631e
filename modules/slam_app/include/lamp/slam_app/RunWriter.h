#pragma once

#include <mrpt/system/CTimeLogger.h>

#include <functional>
#include <string>
#include <vector>

#include "lamp/base_station/BaseStation.h"
#include "lamp/core/RunFolder.h"
#include "lamp/frontend/FrontEnd.h"
#include "lamp/maps/MapExporter.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

/** What the front end has to say about one robot. */
struct FrontEndReport {
  RobotId robot;
  FrontEnd::Counts counts;
  std::vector<std::string> warnings;
};

/** Everything that a run folder is made of. */
struct RunResult {
  const SlamConfig& config;
  const RobotTable& robots;
  const BaseStation& base_station;
  std::vector<FrontEndReport> reports;
  std::vector<std::string> warnings;  ///< of the input, and of the run as a whole
  bool interrupted = false;
  /** World coordinates of the origin of the local frame that the base station works in. */
  Eigen::Vector3d world_p_origin = Eigen::Vector3d::Zero();
};

/** Called before each long step with the share of the writing that is done and what comes next. */
using WriteProgress = std::function<void(double share, const std::string& step)>;

/** Writes the maps of the largest component while the run goes on.
 * \return what was not written and why. */
std::vector<std::string> writeMapSoFar(const RunFolder& folder, const RunResult& result,
                                       const MapExporters& exporters,
                                       mrpt::system::CTimeLogger& timer);

/** Writes all files of docs/run-folder.md but timings.json, which comes last. A file that cannot be
 * written does not keep the others from being written.
 * \param exporters those of the pipeline; they may have written maps of this run before.
 * \return what was not written and why; empty if all was. \throws std::runtime_error if the folder
 * takes nothing at all. */
std::vector<std::string> writeRun(const RunFolder& folder, const RunResult& result,
                                  const MapExporters& exporters, mrpt::system::CTimeLogger& timer,
                                  const WriteProgress& progress);

/** Seconds per stage, peak memory and threads; the one file that differs from run to run. */
void writeTimings(const RunFolder& folder, const mrpt::system::CTimeLogger& timer,
                  const PreparationReport& preparation, int threads);

}  // namespace lamp
