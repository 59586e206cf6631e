#pragma once

#include <map>
#include <string>
#include <vector>

#include "lamp/core/Csv.h"
#include "lamp/core/LoopClosure.h"
#include "lamp/core/PoseGraph.h"
#include "lamp/registration/LoopClosureComputation.h"

namespace lamp {

/** One attempt to close a loop. */
struct LedgerRow {
  size_t loop_id = 0;  ///< of the pair; attempts at one pair share it
  int attempt = 1;
  size_t round = 0;
  size_t rank = 0;  ///< place in its round, from 0
  LoopClosureCandidate candidate;
  Guess guess;
  LoopClosureAttempt outcome;
  std::optional<EdgeIndex> edge;  ///< in the pose graph, if it was accepted
};

/** A change of the back end's verdict on one loop closure. */
struct VerdictChange {
  size_t round = 0;
  size_t loop_id = 0;
  Verdict before = Verdict::kPending, after = Verdict::kPending;
  double gnc_weight = 0;
  double chi2 = 0;
};

/** Everything that was tried, and what became of it: a user who asks why a loop is missing, or why
 * one is there, finds the answer here. */
class Ledger {
 public:
  /** Adds an attempt; loop_id and attempt are filled in. */
  void add(LedgerRow row);
  /** Edges that come from no attempt are ignored. */
  void addVerdictChange(EdgeIndex edge, size_t round, Verdict before, const Edge& after);

  const std::vector<LedgerRow>& rows() const { return rows_; }
  /** Attempts at a pair so far, latest last. */
  std::vector<const LedgerRow*> attempts(KeyNodeId from, KeyNodeId to) const;

  /** The latest accepted attempt at a pair; null if there is none. */
  const LedgerRow* accepted(size_t loop_id) const;

  CsvTable loops(const PoseGraph& graph, const RobotTable& robots) const;
  CsvTable verdicts() const;

 private:
  std::vector<LedgerRow> rows_;
  std::vector<VerdictChange> changes_;
  std::map<std::pair<KeyNodeId, KeyNodeId>, std::vector<size_t>> by_pair_;
  std::map<EdgeIndex, size_t> by_edge_;
};

}  // namespace lamp
