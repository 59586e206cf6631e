#pragma once

#include "lamp/evaluation/CovarianceScore.h"
#include "lamp/evaluation/RunFiles.h"
#include "lamp/evaluation/Truth.h"

namespace lamp::evaluation {

/** Judges the covariances of the odometry edges in graph.g2o, of the robots that the truth knows.
 * \throws std::runtime_error if a file is malformed. */
CovarianceScore evaluateOdometryEdges(const RunFiles& run, const TruthFolder& truth);

}  // namespace lamp::evaluation
