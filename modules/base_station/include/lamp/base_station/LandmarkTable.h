#pragma once

#include "lamp/core/Csv.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** artifacts.csv: where the landmarks are, how sure that is, and how many edges say so. */
CsvTable landmarkTable(const PoseGraph& graph, const RobotTable& robots);

}  // namespace lamp
