#pragma once

#include <string>
#include <vector>

#include "lamp/evaluation/RunEvaluation.h"

namespace lamp::evaluation {

/** Draws all pictures of the runs into a folder, with gnuplot's scripts and data
 * (docs/evaluation.md lists them). \return warnings. \throws std::runtime_error if a file cannot be
 * written. */
std::vector<std::string> drawPictures(const std::vector<RunEvaluation>& runs,
                                      const std::string& folder);

/** What files of a run are named by: nothing for a single run, else its number and name. */
std::string filePrefix(const std::vector<RunEvaluation>& runs, size_t run);

}  // namespace lamp::evaluation
