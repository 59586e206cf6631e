#pragma once

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Whether loop closures meet odometry so much better than the information matrices let expect that
 * these are no measure of errors: with standard deviations of a quarter, or less. Of the loop
 * closures that lie nearer than false ones would by chance, the median tells. False if odometry
 * relates the ends of too few. */
bool overstatesErrors(const PoseGraph& graph);

}  // namespace lamp
