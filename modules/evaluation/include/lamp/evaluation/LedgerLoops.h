#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/RunFolder.h"

namespace lamp::evaluation {

/** A key node as the files of a run name it. */
struct LedgerNode {
  std::string robot;
  uint32_t index = 0;     ///< among the robot's
  uint32_t graph_id = 0;  ///< in graph.g2o
  double stamp = 0;       ///< seconds, UTC
};

/** The last attempt to close the loop between two key nodes. */
struct LedgerLoop {
  LedgerNode from, to;
  Pose3 from_T_to = Pose3::Identity();
  bool has_result = false;  ///< false if it was refused before there was a relative pose
  bool verified = false;    ///< accepted by all verifiers
  bool kept = false;        ///< an inlier of the back end
  /** Tangent space at from_T_to; from graph.g2o, which has loops that are not rejected only. */
  std::optional<Matrix6d> information;

  bool betweenRobots() const { return from.robot != to.robot; }
};

/** Reads graph_ids.csv, in its order: robots one after another, each in time order.
 * \throws std::runtime_error with the file if it is missing or malformed. */
std::vector<LedgerNode> readKeyNodes(const std::string& path);

/** Reads loops.csv, graph_ids.csv and graph.g2o; one loop a pair of key nodes.
 * \throws std::runtime_error with the file if one is missing or malformed. */
std::vector<LedgerLoop> readLedger(const RunFolder& run);

}  // namespace lamp::evaluation
