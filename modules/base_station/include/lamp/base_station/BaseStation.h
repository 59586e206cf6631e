#pragma once

#include <mrpt/system/COutputLogger.h>
#include <mrpt/system/CTimeLogger.h>

#include <atomic>
#include <functional>
#include <memory>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lamp/base_station/BaseStationOptions.h"
#include "lamp/base_station/ExtraEdges.h"
#include "lamp/base_station/Ledger.h"
#include "lamp/base_station/OperatorState.h"
#include "lamp/base_station/RobotPlacements.h"
#include "lamp/base_station/RobotTracks.h"
#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/core/UncertaintyQuery.h"
#include "lamp/loop_candidates/CandidateGenerator.h"
#include "lamp/loop_priority/CandidateQueue.h"
#include "lamp/loop_priority/Prioritizer.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/refinement/JointAdjustment.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/registration/PreparedScanStore.h"

namespace lamp {

/** What a base station is made of. Stages may keep state, so each base station needs its own. */
struct BaseStationSetup {
  BaseStationOptions options;
  bool inter_robot_loops = true;
  std::vector<std::shared_ptr<CandidateGenerator>> candidates;
  std::shared_ptr<Prioritizer> priority;
  PreparationOptions preparation;
  LoopClosureComputation computation;
  BackEnd back_end;
  RefinementOptions refinement;
  ExtraEdges extra_edges;
};

/** The multi-robot front end and back end of the paper (II-C, II-D), driven by arriving key nodes:
 * register the node, find and compute its loop closures, optimise when enough has been learnt.
 *
 * Registrations run on the caller's TBB arena; everything else, and all writing, on the calling
 * thread in candidate order, so results do not depend on the number of threads.
 */
class BaseStation : public mrpt::system::COutputLogger {
 public:
  BaseStation(BaseStationSetup setup, mrpt::system::CTimeLogger& timer);

  /** \param interrupted may become true at any time; registrations that have not begun are
   * then skipped. */
  void receive(const KeyNodePacket& packet, const std::atomic<bool>& interrupted = kNever);
  void receive(const RobotEnd& end);
  /** Carries out what an operator asked for, and optimises. \return `done`, or why it cannot be
   * done. */
  std::string apply(const OperatorAction& action, const RobotTable& robots);
  /** Computes what still waits, until `interrupted`, and optimises a last time. */
  void finish(const std::atomic<bool>& interrupted);
  /** Adjusts all scans together; nothing may be received after it. Where no loop closures are
   * sought, or an operator has frozen the map, poses stay. \param go_on asked now and then, with
   * the share of the work that is done, whether to go on. */
  void refine(const std::function<bool(double share)>& go_on);

  const PoseGraph& graph() const { return graph_; }
  const Ledger& ledger() const { return ledger_; }
  const std::vector<ActionRecord>& actions() const { return actions_; }
  size_t candidates() const { return candidate_count_; }
  size_t optimizations() const { return optimization_count_; }
  const OptimizationReport& lastReport() const { return report_; }
  const JointAdjustmentReport& refinement() const { return refinement_; }
  PreparationReport preparation() const { return scans_.report(); }
  const RobotTracks& tracks() const { return tracks_; }

 private:
  inline static const std::atomic<bool> kNever{false};

  void propose(KeyNodeId id);
  bool isWorthTrying(const LoopClosureCandidate& candidate) const;
  void computeRound(size_t budget, const std::atomic<bool>& interrupted);
  void record(const LoopClosureCandidate& candidate, const Guess& guess, LoopClosureAttempt attempt,
              size_t rank);
  bool optimizationDue() const;
  void optimize();
  OptimizationResult solve();
  bool misplaced(const OptimizationResult& result);
  void proposeAgain();
  /** Robots that share a frame with another one, and did not at the last call. */
  std::set<RobotId> robotsThatMet();

  const BaseStationOptions options_;
  const bool inter_robot_loops_;
  const std::vector<std::shared_ptr<CandidateGenerator>> generators_;
  const std::shared_ptr<Prioritizer> priority_;
  const LoopClosureComputation computation_;
  const BackEnd back_end_;
  const RefinementOptions refinement_options_;
  mrpt::system::CTimeLogger& timer_;

  PoseGraph graph_;
  PreparedScanStore scans_;
  CandidateQueue queue_;
  Ledger ledger_;
  ExtraEdges extra_edges_;
  OperatorState operator_;
  std::vector<ActionRecord> actions_;
  RobotTracks tracks_;
  RobotPlacements placements_;
  /** Where each key node stood when candidates were last sought for it. */
  std::unordered_map<KeyNodeId, Eigen::Vector3d> proposed_at_;
  std::set<std::pair<RobotId, RobotId>> share_frame_;

  size_t round_ = 0;
  size_t candidate_count_ = 0;
  size_t optimization_count_ = 0;
  size_t loops_ = 0;
  size_t optimized_loops_ = 0;
  bool optimized_all_ = true;
  OptimizationReport report_;
  JointAdjustmentReport refinement_;
};

}  // namespace lamp
