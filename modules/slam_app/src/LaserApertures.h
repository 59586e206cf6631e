#pragma once

#include <atomic>
#include <map>

#include "lamp/frontend/ApertureSurvey.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

/** Reads the beginning of the recordings, and finds the robots whose 2D laser has another field of
 * view than is recorded. None if the configuration says what it is, or robots have no such laser.
 * \param interrupted ends it early with what has been found. */
std::map<RobotId, ApertureSurvey::Correction> measureApertures(
    const SlamConfig& config, const std::atomic<bool>& interrupted);

}  // namespace lamp
