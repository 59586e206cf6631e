#pragma once

#include <string>

#include "lamp/simulation/SimConfig.h"

namespace lamp::simulation {

/** What `lamp-sim` does once it knows its arguments. */
struct SimJob {
  std::string out;  ///< folder; must be new or empty
  uint64_t seed = 1;
  bool raw = false;  ///< full rate instead of key nodes only
  int threads = 1;   ///< results do not depend on it
};

/** Makes a world, lets the team drive through it, and writes rawlogs, truth and an experiment file.
 * \return what was made, for the user. \throws std::runtime_error if a file cannot be written. */
std::string simulate(const SimConfig& config, const SimJob& job);

}  // namespace lamp::simulation
