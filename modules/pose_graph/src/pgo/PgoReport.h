#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lamp/core/Csv.h"
#include "lamp/core/G2oFile.h"
#include "lamp/pose_graph/Optimizer.h"

namespace lamp {

/** What lamp-pgo tells of a run: counts, costs, a row for each edge with weight, verdict and
 * squared residual. \param true_edges number of edges that the file brought; those behind are false
 * loops, by which precision and recall are counted if there are any. */
nlohmann::ordered_json pgoReport(const G2oGraph& g2o, const OptimizationResult& result,
                                 size_t true_edges);

/** The covariance of each node's pose at the graph's estimate, by its id in the file: upper
 * triangle in the tangent space at the pose, relative to the first node of each component that no
 * prior reaches. */
CsvTable covarianceTable(const G2oGraph& g2o);

/** The main figures in a few lines. */
std::string pgoSummary(const nlohmann::ordered_json& report);

}  // namespace lamp
