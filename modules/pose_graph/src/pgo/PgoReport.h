#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lamp/core/Csv.h"
#include "lamp/core/G2oFile.h"
#include "lamp/pose_graph/Optimizer.h"

namespace lamp {

/** What lamp-pgo reports about a run: counts, costs, and a row for each edge with weight, verdict
 * and squared residual.
 * \param true_edges number of edges from the file; any edges after these are false loops, for which
 * precision and recall are reported. */
nlohmann::ordered_json pgoReport(const G2oGraph& g2o, const OptimizationResult& result,
                                 size_t true_edges);

/** The covariance of each node's pose at the graph's estimate, by its id in the file: the upper
 * triangle, in the tangent space at the pose; in a component that no prior reaches, relative to the
 * component's first node. */
CsvTable covarianceTable(const G2oGraph& g2o);

/** The main figures in a few lines. */
std::string pgoSummary(const nlohmann::ordered_json& report);

}  // namespace lamp
