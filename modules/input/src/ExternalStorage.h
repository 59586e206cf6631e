#pragma once

#include <mrpt/obs/CObservation.h>

#include <string>

namespace lamp {

/** The folder that holds what a rawlog stores in files of their own: `<stem>_Images` beside it, as
 * MRPT's tools name it, else the rawlog's folder. */
std::string externalStorageFolder(const std::string& rawlog);

/** Loads a lidar observation's data from its own file and makes them part of the observation, so
 * that nobody later needs to know the folder. Other observations stay as they are.
 *  \return false if the file cannot be loaded. */
bool loadExternalData(mrpt::obs::CObservation& observation, const std::string& folder);

}  // namespace lamp
