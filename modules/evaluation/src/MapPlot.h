#pragma once

#include <string>

#include "Gnuplot.h"
#include "lamp/evaluation/RunEvaluation.h"

namespace lamp::evaluation {

/** `<prefix>map_error` (`map_2_error`, ...): the map from above, coloured by its distance to the
 * true surface; the largest errors lie on top. */
void drawMapError(const RunEvaluation& run, const MapEvaluation& map, const std::string& prefix,
                  Gnuplot& gnuplot);

}  // namespace lamp::evaluation
