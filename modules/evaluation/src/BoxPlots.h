#pragma once

#include <vector>

#include "Gnuplot.h"
#include "lamp/evaluation/RunEvaluation.h"

namespace lamp::evaluation {

/** `ate_boxes`: the spread of the position errors of each robot and of all together; result and
 * odometry of one run, or the results of several runs side by side, with the odometry of the
 * first. Boxes are quartiles with the median, whiskers reach from 5 % to 95 %. */
void drawBoxPlots(const std::vector<RunEvaluation>& runs, Gnuplot& gnuplot);

}  // namespace lamp::evaluation
