#pragma once

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Whether loop closures agree with odometry so much better than the information matrices suggest,
 * with a quarter of the stated standard deviations or less, that these are no measure of errors.
 * This is judged by the median of the loop closures that lie nearer than false ones would by
 * chance. False if odometry relates the ends of too few. */
bool overstatesErrors(const PoseGraph& graph);

}  // namespace lamp
