#include "lamp/slam_app/SlamRun.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <exception>
#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "Delivery.h"
#include "FrontEndTeam.h"
#include "LaserApertures.h"
#include "RunDescription.h"
#include "RunWarnings.h"
#include "TeamArrivals.h"
#include "WorldFrame.h"
#include "lamp/base_station/BaseStation.h"
#include "lamp/core/Progress.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/slam_app/RunWriter.h"
#include "lamp/transport/InProcessQueue.h"

namespace lamp {

namespace {

using mrpt::system::CTimeLogger;
using mrpt::system::CTimeLoggerEntry;

constexpr size_t kQueuedMessages = 16;

/** Reads the input and runs the front ends on a thread of its own, ahead of the base station. */
class FrontEndThread {
 public:
  FrontEndThread(const SlamConfig& config, RawlogSource& source, FrontEndTeam& team,
                 InProcessQueue& queue, const std::atomic<bool>& interrupted)
      : queue_(queue), thread_([this, &config, &source, &team, &interrupted] {
          try {
            run(config, source, team, interrupted);
          } catch (...) {
            failure_ = std::current_exception();
          }
          queue_.closeSender();
        }) {}

  ~FrontEndThread() {
    queue_.closeReceiver();
    if (thread_.joinable()) thread_.join();
  }

  /** While the lock is held nothing is read, so no robot can appear. */
  std::unique_lock<std::mutex> pause() { return std::unique_lock<std::mutex>(reading_); }

  /** Share of the input read. */
  double progress() const { return progress_; }

  /** Waits for the end and passes on what went wrong. */
  void join() {
    thread_.join();
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void run(const SlamConfig& config, RawlogSource& source, FrontEndTeam& team,
           const std::atomic<bool>& interrupted) {
    while (!interrupted) {
      std::optional<InputObservation> observation;
      {
        const std::lock_guard<std::mutex> lock(reading_);
        observation = source.next();
        requireArrivals(config, source.robots());  // robots appear as they are read
      }
      if (!observation || !team.observe(*observation)) break;
      progress_ = source.progress();
    }
    team.finish();
  }

  InProcessQueue& queue_;
  std::mutex reading_;
  std::atomic<double> progress_{0};
  std::exception_ptr failure_;
  std::thread thread_;
};

std::string describeLoops(const BaseStation& base) {
  size_t verified = 0;
  for (const LedgerRow& row : base.ledger().rows()) verified += row.outcome.accepted ? 1 : 0;
  return std::to_string(base.graph().nodes().size()) + " key nodes, " + std::to_string(verified) +
         " loop closures verified of " + std::to_string(base.ledger().rows().size());
}

/** Why no key node came out, from what the front ends and the input say. */
std::string explainEmptyRun(const std::vector<FrontEndReport>& reports, const RobotTable& robots,
                            const std::vector<std::string>& input_warnings) {
  std::string text = "there is no key node to map:";
  for (const FrontEndReport& report : reports)
    for (const std::string& warning : report.warnings)
      text += "\n  robot '" + robots.name(report.robot) + "': " + warning;
  for (const std::string& warning : input_warnings) text += "\n  " + warning;
  if (reports.empty()) text += "\n  the input holds no observation of any robot";
  return text;
}

}  // namespace

SlamRun::SlamRun(SlamConfig config, Job job, const std::atomic<bool>& interrupted)
    : COutputLogger("lamp-slam"),
      config_(std::move(config)),
      world_p_origin_(localOrigin(config_)),
      local_(inLocalFrame(config_, world_p_origin_)),
      job_(std::move(job)),
      interrupted_(interrupted) {}

void SlamRun::warn(const std::vector<std::string>& warnings, const std::string& prefix) {
  for (const std::string& warning : warnings) MRPT_LOG_WARN_STREAM(prefix << warning);
}

bool SlamRun::actionDue(const BaseStation& base) const {
  return next_action_ < job_.actions.size() &&
         job_.actions[next_action_].key_nodes <= base.tracks().packets().size();
}

bool SlamRun::mapsDue(const BaseStation& base) const {
  const int every = config_.run.maps_every_key_nodes;
  return every > 0 && base.tracks().packets().size() % static_cast<size_t>(every) == 0;
}

void SlamRun::act(BaseStation& base, const RobotTable& robots, bool all) {
  for (; all ? next_action_ < job_.actions.size() : actionDue(base); ++next_action_) {
    const OperatorAction& action = job_.actions[next_action_];
    const std::string outcome = base.apply(action, robots);
    if (outcome != "done") MRPT_LOG_WARN_STREAM(action.where << ": not done: " << outcome);
  }
}

void SlamRun::refine(BaseStation& base) const {
  Progress progress;
  tbb::task_arena arena(job_.threads);
  arena.execute([&] {
    base.refine([&](double share) {
      progress.show(share, "adjusting all scans together");
      return !interrupted_;
    });
  });
}

SlamRun::Outcome SlamRun::run() {
  RobotTable robots;
  RawlogSource source(config_.input.rawlogs, config_.robots, robots);
  requireArrivals(config_, source.robots());
  InProcessQueue queue(kQueuedMessages);
  Delivery delivery(config_, queue);
  const RunFolder folder = RunFolder::create(job_.out);
  const tbb::global_control thread_limit(tbb::global_control::max_allowed_parallelism,
                                         static_cast<size_t>(job_.threads));
  CTimeLogger timer(true, "lamp-slam");
  timer.setMinLoggingLevel(mrpt::system::LVL_ERROR);  // it would print itself when destroyed
  BaseStation base_station(local_.makeBaseStationSetup(), timer);
  base_station.setMinLoggingLevel(getMinLoggingLevel());

  const MapExporters exporters = config_.makeMapExporters();
  FrontEndTeam team(local_, queue, measureApertures(local_, interrupted_));
  {
    Progress progress;
    const CTimeLoggerEntry timing(timer, "run");
    FrontEndThread front_end(local_, source, team, queue, interrupted_);
    tbb::task_arena arena(job_.threads);
    arena.execute([&] {
      while (const auto message = interrupted_ ? std::nullopt : delivery.receive()) {
        const auto* packet = std::get_if<KeyNodePacket>(&*message);
        if (packet)
          base_station.receive(*packet, interrupted_);
        else
          base_station.receive(std::get<RobotEnd>(*message));
        if (actionDue(base_station)) {
          const auto paused = front_end.pause();
          act(base_station, robots, false);
        }
        if (packet && mapsDue(base_station)) {
          const auto paused = front_end.pause();
          const RunResult so_far{config_, robots, base_station, {}, {}, false, world_p_origin_};
          warn(writeMapSoFar(folder, so_far, exporters, timer), "map so far: ");
        }
        if (progress.due())
          progress.show(front_end.progress() * delivery.share(), describeLoops(base_station));
      }
      queue.closeReceiver();  // after Ctrl-C the front end may be waiting for room in the queue
      base_station.finish(interrupted_);
      if (!interrupted_) act(base_station, robots, true);
      base_station.finish(interrupted_);
    });
    front_end.join();
  }
  refine(base_station);

  RunResult result{config_,           robots,       base_station,   team.reports(),
                   source.warnings(), interrupted_, world_p_origin_};
  if (base_station.graph().nodes().empty() && interrupted_)
    throw std::runtime_error("interrupted before the first key node: there is nothing to map");
  if (base_station.graph().nodes().empty())
    throw std::runtime_error(explainEmptyRun(result.reports, robots, result.warnings));
  for (std::string& warning : runWarnings(base_station))
    result.warnings.push_back(std::move(warning));
  warn(result.warnings);
  for (const FrontEndReport& report : result.reports)
    warn(report.warnings, "robot '" + robots.name(report.robot) + "': ");
  Outcome outcome{describeRun(folder, result), {}};
  {
    Progress progress;
    outcome.not_written =
        writeRun(folder, result, exporters, timer,
                 [&](double share, const std::string& step) { progress.show(share, step); });
  }
  try {
    writeTimings(folder, timer, base_station.preparation(), job_.threads);
  } catch (const std::exception& error) {
    outcome.not_written.emplace_back(error.what());
  }
  return outcome;
}

}  // namespace lamp
