#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lamp/evaluation/Relations.h"
#include "lamp/evaluation/TrajectoryEvaluation.h"

namespace lamp {

/** What a run is compared with. */
struct EvaluationInput {
  std::optional<TruthFolder> truth;
  std::string relations, scan_stamps;  ///< both or none
  Alignment alignment = Alignment::kNone;
};

struct RelationEvaluation {
  RelationErrors result, odometry;
};

/** All that was measured of one run. Parts for which there are no files are empty, and `notes` say
 * why. */
struct RunEvaluation {
  std::string name;  ///< unique among the runs of a report
  RunFiles run;
  std::optional<TrajectoryEvaluation> trajectories;
  std::optional<RelationEvaluation> relations;
  std::vector<std::string> notes;
};

/** \throws std::runtime_error if a file is damaged, or nothing can be compared. */
RunEvaluation evaluateRun(const std::string& root, const EvaluationInput& input);

}  // namespace lamp
