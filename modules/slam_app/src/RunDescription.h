#pragma once

#include <string>

#include "lamp/slam_app/RunWriter.h"

namespace lamp {

/** What a user wants to know at the end of a run, a few lines. */
std::string describeRun(const RunFolder& folder, const RunResult& result);

}  // namespace lamp
