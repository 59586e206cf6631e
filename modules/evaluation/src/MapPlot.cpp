#include "MapPlot.h"

#include <algorithm>
#include <numeric>

#include "TrajectoryPlots.h"
#include "lamp/core/Colormap.h"
#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

constexpr size_t kMaxPoints = 300000;

/** Every n-th point, least error first. */
std::vector<size_t> chosenPoints(const MapEvaluation& map) {
  const size_t step = map.points.size() / kMaxPoints + 1;
  std::vector<size_t> chosen;
  for (size_t i = 0; i < map.points.size(); i += step) chosen.push_back(i);
  std::stable_sort(chosen.begin(), chosen.end(),
                   [&](size_t a, size_t b) { return map.errors_m[a] < map.errors_m[b]; });
  return chosen;
}

std::string paletteScript() {
  std::string text = "set palette defined (";
  for (size_t i = 0; i < kViridis.size(); ++i) {
    text += i == 0 ? "" : ", ";
    text += std::to_string(i);
    for (const uint8_t channel : kViridis[i]) text += " " + formatFixed(channel / 255.0, 3);
  }
  return text + ")\n";
}

}  // namespace

void drawMapError(const RunEvaluation& run, const MapEvaluation& map, const std::string& prefix,
                  Gnuplot& gnuplot) {
  const std::string name = prefix + map.name + "_error";
  std::string data = "# x y [m], distance to the true surface [m]\n";
  for (const size_t i : chosenPoints(map))
    data += formatFixed(map.points[i].x(), 3) + " " + formatFixed(map.points[i].y(), 3) + " " +
            formatFixed(map.errors_m[i], 4) + "\n";
  gnuplot.draw(name, 1200, 1000,
               titleOf(run, "Map error, seen from above") +
                   "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nunset key\n" +
                   paletteScript() + "set cbrange [0:" + formatDouble(errorScale(map)) +
                   "]\nset cblabel 'distance to the true surface [m]'\nplot '" + name +
                   ".dat' using 1:2:3 with points pt 7 ps 0.25 lc palette\n",
               data);
}

}  // namespace lamp::evaluation
