#pragma once

#include <string>

#include "Gnuplot.h"
#include "lamp/evaluation/RunEvaluation.h"

namespace lamp::evaluation {

/** `<prefix>trajectories_top` and `_side`: all robots against the truth, from above and along y. */
void drawTrajectories(const RunEvaluation& run, const std::string& prefix, Gnuplot& gnuplot);

/** `<prefix>error_over_distance`: position error of result and odometry over the distance
 * travelled. */
void drawErrorOverDistance(const RunEvaluation& run, const std::string& prefix, Gnuplot& gnuplot);

/** "RUN, alignment X", for titles. */
std::string titleOf(const RunEvaluation& run, const std::string& what);

/** Two sets of errors are so different that only a logarithmic axis shows both. */
bool needsLogarithm(double small_max, double large_max);
/** That axis; less than a millimetre is not drawn. */
constexpr const char* kLogarithmicError =
    "set logscale y\nset yrange [0.001:*]\nset format y '%g'\n";

}  // namespace lamp::evaluation
