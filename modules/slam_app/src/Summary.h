#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "lamp/base_station/LoopCounts.h"
#include "lamp/slam_app/RunWriter.h"

namespace lamp {

/** The content of summary.json. \param not_written files that are missing, and why. */
nlohmann::ordered_json summarize(const RunResult& result,
                                 const std::vector<std::string>& not_written = {});

}  // namespace lamp
