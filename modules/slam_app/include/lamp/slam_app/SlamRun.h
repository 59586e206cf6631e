#pragma once

#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/CTimeLogger.h>

#include <atomic>
#include <string>
#include <vector>

#include "lamp/base_station/OperatorActions.h"
#include "lamp/core/RunFolder.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

class BaseStation;

/** One experiment from rawlogs to a run folder; what `lamp-slam` does once it knows its arguments.
 */
class SlamRun : public mrpt::system::COutputLogger {
 public:
  struct Job {
    std::string out;                      ///< folder of the run; must be new or empty
    int threads = 1;                      ///< for registration
    std::vector<OperatorAction> actions;  ///< by key_nodes
  };

  /** \param interrupted may be set from a signal handler: the run then ends early with what it has.
   */
  SlamRun(SlamConfig config, Job job, const std::atomic<bool>& interrupted);

  struct Outcome {
    std::string text;                      ///< what was found, for the user
    std::vector<std::string> not_written;  ///< results that are missing, and why
  };

  /** \throws std::runtime_error if there is nothing to map, a recording cannot be read, or nothing
   * at all can be written. */
  Outcome run();

 private:
  bool actionDue(const BaseStation& base) const;
  /** Whether the newest key node is one after which maps are written. */
  bool mapsDue(const BaseStation& base) const;
  /** Does the actions that are due, or all. */
  void act(BaseStation& base, const RobotTable& robots, bool all);
  /** Adjusts all scans together, and shows how far that is. */
  void refine(BaseStation& base) const;
  void warn(const std::vector<std::string>& warnings, const std::string& prefix = "");

  SlamConfig config_;
  const Eigen::Vector3d world_p_origin_;  ///< of the local frame that all stages work in
  const SlamConfig local_;                ///< the configuration in that frame
  const Job job_;
  size_t next_action_ = 0;
  const std::atomic<bool>& interrupted_;
};

}  // namespace lamp
