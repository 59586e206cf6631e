#pragma once

#include <string>
#include <vector>

#include "lamp/input/InputReport.h"
#include "lamp/input/RobotOptions.h"

namespace lamp {

std::vector<std::string> recordingWarnings(const RecordingReport& recording);
std::vector<std::string> robotWarnings(const RobotReport& robot, const RobotOptions& options);

}  // namespace lamp
