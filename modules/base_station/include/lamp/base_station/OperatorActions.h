#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Csv.h"
#include "lamp/core/Geometry.h"

namespace lamp {

enum class ActionKind {
  kRemove,    ///< a loop closure leaves the graph; its pair may be tried again
  kVeto,      ///< a loop closure leaves the graph, and its pair is not tried again
  kPin,       ///< a loop closure that no outlier rejection may reject
  kRestore,   ///< undoes remove, veto and pin
  kAdd,       ///< a loop closure by hand, pinned
  kIgnore,    ///< a robot's loop closures with the others stay out
  kRevive,    ///< undoes ignore
  kFreeze,    ///< no optimisation from now on
  kUnfreeze,  ///< undoes freeze
  kReset,     ///< undoes all actions so far
};

/** What an operator did to the map, and when. */
struct OperatorAction {
  size_t key_nodes = 0;  ///< how many the base station had then
  ActionKind kind = ActionKind::kReset;
  std::optional<size_t> loop_id;  ///< of loops.csv; or the pair
  std::string from, to;           ///< `robot:index`
  std::string robot;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of `to` in the frame of `from`
  Eigen::Quaterniond rotation =
      Eigen::Quaterniond::Identity();  ///< as given, so that a replay is exact
  double sigma_m = 0, sigma_deg = 0;   ///< of both
  std::string where;                   ///< file and line
};

/** An action with what became of it: `done`, or why it was not. */
struct ActionRecord {
  OperatorAction action;
  std::string outcome;
};

/** Reads an actions file (docs/run-folder.md), sorted by key_nodes; rows with the same keep their
 * order. \throws std::runtime_error naming file, line and column. */
std::vector<OperatorAction> readActions(const std::string& path);

/** The same format, with the outcomes. */
CsvTable toCsv(const std::vector<ActionRecord>& records);

}  // namespace lamp
