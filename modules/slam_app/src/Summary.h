#pragma once

#include <nlohmann/json.hpp>

#include "lamp/base_station/LoopCounts.h"
#include "lamp/slam_app/RunWriter.h"

namespace lamp {

/** The content of summary.json. */
nlohmann::ordered_json summarize(const RunResult& result);

}  // namespace lamp
