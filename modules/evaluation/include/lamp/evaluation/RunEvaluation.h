#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lamp/evaluation/LoopEvaluation.h"
#include "lamp/evaluation/MapEvaluation.h"
#include "lamp/evaluation/OctoMapEvaluation.h"
#include "lamp/evaluation/OdometryEdges.h"
#include "lamp/evaluation/Relations.h"
#include "lamp/evaluation/TrajectoryEvaluation.h"

namespace lamp::evaluation {

/** The true surface, and where the robots truly were. */
struct TrueWorld {
  TrueSurface surface;
  std::vector<Eigen::Vector3f> positions;  ///< of all robots' bases, in the surface's frame, metres

  /** Null if the truth has no map. \throws std::runtime_error if a file is malformed. */
  static std::shared_ptr<const TrueWorld> open(const TruthFolder& truth);
};

/** What runs are compared with. */
struct EvaluationInput {
  std::optional<TruthFolder> truth;
  std::shared_ptr<const TrueWorld> world;  ///< null if there is no map of the truth
  std::string relations, scan_stamps;      ///< both or none
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
  std::optional<CovarianceScore> odometry_edges;
  std::optional<LoopEvaluation> loops;
  std::vector<MapEvaluation> maps;
  std::optional<OctoMapEvaluation> octomap;  ///< of the largest component
  std::optional<RelationEvaluation> relations;
  std::vector<std::string> notes;
};

/** \param progress is told, before each part, the share that is done and what comes next.
 *  \throws std::runtime_error if a file is damaged, or nothing can be compared. */
RunEvaluation evaluateRun(const std::string& root, const EvaluationInput& input,
                          const std::function<void(double, const std::string&)>& progress);

}  // namespace lamp::evaluation
