#pragma once

#include <string>
#include <vector>

#include "lamp/base_station/BaseStation.h"

namespace lamp {

/** What a user should know about a run as a whole. */
std::vector<std::string> runWarnings(const BaseStation& base);

}  // namespace lamp
