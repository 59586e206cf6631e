#include "Pictures.h"

#include "BoxPlots.h"
#include "Gnuplot.h"
#include "MapPlot.h"
#include "TrajectoryPlots.h"
#include "lamp/core/Ids.h"

namespace lamp::evaluation {

std::vector<std::string> drawPictures(const std::vector<RunEvaluation>& runs,
                                      const std::string& folder) {
  Gnuplot gnuplot(folder);
  for (size_t i = 0; i < runs.size(); ++i) {
    const std::string prefix = filePrefix(runs, i);
    if (runs[i].trajectories) {
      drawTrajectories(runs[i], prefix, gnuplot);
      drawErrorOverDistance(runs[i], prefix, gnuplot);
    }
    for (const MapEvaluation& map : runs[i].maps) drawMapError(runs[i], map, prefix, gnuplot);
  }
  drawBoxPlots(runs, gnuplot);
  return gnuplot.warnings();
}

std::string filePrefix(const std::vector<RunEvaluation>& runs, size_t run) {
  if (runs.size() == 1) return "";
  return std::to_string(run + 1) + "_" + robotNameFromStem(runs[run].name) + "_";
}

}  // namespace lamp::evaluation
