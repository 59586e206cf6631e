#include "BoxPlots.h"

#include <algorithm>

#include "TrajectoryPlots.h"
#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

/** The boxes of one colour: of each robot, and of all together at the end. */
struct Series {
  std::string title, color;
  std::vector<std::vector<double>> errors;  ///< empty where a run does not have the robot
};

std::vector<std::string> robotsOf(const std::vector<RunEvaluation>& runs) {
  std::vector<std::string> names;
  for (const RunEvaluation& run : runs)
    for (const RobotEvaluation& robot : run.trajectories->robots)
      if (std::find(names.begin(), names.end(), robot.name) == names.end())
        names.push_back(robot.name);
  return names;
}

Series seriesOf(const RunEvaluation& run, const std::vector<std::string>& robots, bool odometry,
                const std::string& title, const std::string& color) {
  const auto errorsOf = [&](const TrajectoryScore& result, const TrajectoryScore& of_odometry) {
    return (odometry ? of_odometry : result).error.position_m;
  };
  Series series{title, color, std::vector<std::vector<double>>(robots.size())};
  const TrajectoryEvaluation& all = *run.trajectories;
  for (const RobotEvaluation& robot : all.robots) {
    const auto place = std::find(robots.begin(), robots.end(), robot.name) - robots.begin();
    series.errors[static_cast<size_t>(place)] = errorsOf(robot.result, robot.odometry);
  }
  if (robots.size() > 1) series.errors.push_back(errorsOf(all.result, all.odometry));
  return series;
}

std::vector<Series> allSeries(const std::vector<RunEvaluation>& runs,
                              const std::vector<std::string>& robots) {
  std::vector<Series> series;
  for (size_t i = 0; i < runs.size(); ++i)
    series.push_back(
        seriesOf(runs[i], robots, false, runs.size() == 1 ? "result" : runs[i].name, lineColor(i)));
  series.push_back(seriesOf(runs[0], robots, true, "odometry", "'#999999'"));
  return series;
}

/** One block a series, one row a box. */
std::string boxData(const std::vector<Series>& all, double width) {
  std::string data;
  for (size_t s = 0; s < all.size(); ++s) {
    data += "# " + all[s].title + ": place, 5 %, 25 %, 50 %, 75 %, 95 % of the error [m]\n";
    for (size_t group = 0; group < all[s].errors.size(); ++group) {
      std::vector<double> errors = all[s].errors[group];
      if (errors.empty()) continue;
      std::sort(errors.begin(), errors.end());
      const double offset = (static_cast<double>(s) - 0.5 * static_cast<double>(all.size() - 1));
      data += formatFixed(static_cast<double>(group + 1) + width * offset, 4);
      for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95})
        data += " " + formatFixed(quantile(errors, share), 5);
      data += "\n";
    }
    data += "\n\n";
  }
  return data;
}

double largestError(const Series& series) {
  double largest = 0;
  for (const auto& errors : series.errors)
    for (const double error : errors) largest = std::max(largest, error);
  return largest;
}

std::string ticks(std::vector<std::string> groups) {
  if (groups.size() > 1) groups.push_back("all");
  std::string text = "set xrange [0.4:" + formatDouble(static_cast<double>(groups.size()) + 0.6) +
                     "]\nset xtics (";
  for (size_t i = 0; i < groups.size(); ++i)
    text += (i == 0 ? "" : ", ") + Gnuplot::quoted(groups[i]) + " " + std::to_string(i + 1);
  return text + ")\n";
}

std::string boxLines(const std::vector<Series>& all) {
  std::string lines;
  for (size_t s = 0; s < all.size(); ++s) {
    if (largestError(all[s]) == 0 && all[s].errors.front().empty()) continue;
    const std::string block = "'ate_boxes.dat' index " + std::to_string(s);
    lines += (lines.empty() ? "" : ", \\\n") + ("  " + block) +
             " using 1:3:2:6:5 with candlesticks whiskerbars 0.5 lw 2 lc rgb " + all[s].color +
             " title " + Gnuplot::quoted(all[s].title) + ", \\\n  " + block +
             " using 1:4:4:4:4 with candlesticks lw 3 lc rgb 'black' notitle";
  }
  return lines;
}

}  // namespace

void drawBoxPlots(const std::vector<RunEvaluation>& runs, Gnuplot& gnuplot) {
  if (!runs.front().trajectories) return;
  const auto robots = robotsOf(runs);
  const auto series = allSeries(runs, robots);
  const double width = 0.8 / static_cast<double>(series.size());
  const bool logarithm = needsLogarithm(largestError(series.front()), largestError(series.back()));
  const std::string script =
      "set title " +
      Gnuplot::quoted("Position error (5, 25, 50, 75, 95 %): " +
                      (runs.size() == 1 ? runs[0].name : std::to_string(runs.size()) + " runs") +
                      ", alignment " + toString(runs[0].trajectories->alignment)) +
      "\nset boxwidth " + formatFixed(0.8 * width, 4) + "\nset style fill solid 0.35\n" +
      ticks(robots) + (logarithm ? kLogarithmicError : "set yrange [0:*]\n") +
      "set ylabel 'position error [m]'\nset grid noxtics\n"
      "plot \\\n" +
      boxLines(series) + "\n";
  const int width_px =
      std::clamp(500 + static_cast<int>(60 * robots.size() * series.size()), 800, 2400);
  gnuplot.draw("ate_boxes", width_px, 700, script, boxData(series, width));
}

}  // namespace lamp::evaluation
