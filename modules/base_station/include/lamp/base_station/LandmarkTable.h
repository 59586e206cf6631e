#pragma once

#include "lamp/core/Csv.h"
#include "lamp/core/PoseGraph.h"

namespace lamp {

/** artifacts.csv: where the landmarks are, how certain that is, and how many edges measure it. */
CsvTable landmarkTable(const PoseGraph& graph, const RobotTable& robots);

}  // namespace lamp
