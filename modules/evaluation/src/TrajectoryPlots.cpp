#include "TrajectoryPlots.h"

#include <algorithm>
#include <limits>

#include "lamp/core/Csv.h"

namespace lamp::evaluation {

namespace {

/** Positions as gnuplot data; an empty line where poses are left out. */
void appendPositions(const std::vector<JoinedPose>& poses, const Pose3& T, Pose3 JoinedPose::*which,
                     const std::string& comment, std::string& data) {
  data += "# " + comment + ": x y z [m]\n";
  for (size_t i = 0; i < poses.size(); ++i) {
    if (i > 0 && poses[i].row != poses[i - 1].row + 1) data += "\n";
    const Eigen::Vector3d p = (T * (poses[i].*which)).translation();
    data +=
        formatFixed(p.x(), 4) + " " + formatFixed(p.y(), 4) + " " + formatFixed(p.z(), 4) + "\n";
  }
  data += "\n\n";
}

/** Of each robot: block 2k the truth, block 2k + 1 the result. */
std::string positions(const TrajectoryEvaluation& evaluation) {
  std::string data;
  for (const RobotEvaluation& robot : evaluation.robots) {
    appendPositions(robot.poses, Pose3::Identity(), &JoinedPose::truth, robot.name + ", truth",
                    data);
    appendPositions(robot.poses, robot.truth_T_world, &JoinedPose::estimate,
                    robot.name + ", result", data);
  }
  return data;
}

std::string viewScript(const TrajectoryEvaluation& evaluation, const std::string& file,
                       const std::string& columns) {
  std::string script = "plot \\\n";
  const auto block = [&](size_t index) { return "'" + file + "' index " + std::to_string(index); };
  for (size_t i = 0; i < evaluation.robots.size(); ++i)
    script += "  " + block(2 * i + 1) + " using " + columns + " with lines lw 3 lc rgb " +
              lineColor(i) + " title " + Gnuplot::quoted(evaluation.robots[i].name) + ", \\\n";
  for (size_t i = 0; i < evaluation.robots.size(); ++i)
    script += "  " + block(2 * i) + " using " + columns + " with lines lw 1 lc rgb 'black' " +
              (i == 0 ? "title 'truth'" : "notitle") + ", \\\n";
  for (size_t i = 0; i < evaluation.robots.size(); ++i)
    script += "  " + block(2 * i + 1) + " every ::0:0:0:0 using " + columns +
              " with points pt 7 ps 1.6 lc rgb " + lineColor(i) +
              (i == 0 ? " title 'start'" : " notitle") +
              (i + 1 < evaluation.robots.size() ? ", \\\n" : "\n");
  return script;
}

void appendErrors(const TrajectoryError& error, const std::string& comment, std::string& data) {
  data += "# " + comment + ": distance [m], position error [m], rotation error [deg]\n";
  for (size_t i = 0; i < error.position_m.size(); ++i)
    data += formatFixed(error.distance_m[i], 3) + " " + formatFixed(error.position_m[i], 5) + " " +
            formatFixed(error.rotation_deg[i], 4) + "\n";
  data += "\n\n";
}

/** The drawn range of one coordinate of truth and result, with a margin. */
struct Extent {
  double min = std::numeric_limits<double>::infinity(), max = -min;

  void add(double value) {
    min = std::min(min, value);
    max = std::max(max, value);
  }
  double length() const { return max - min; }
  /** Grows to both sides, so that axes of equal scale have room for their labels. */
  void growTo(double wanted) {
    const double missing = std::max(0.0, wanted - length());
    min -= 0.5 * missing;
    max += 0.5 * missing;
  }
  std::string range() const { return "[" + formatFixed(min, 3) + ":" + formatFixed(max, 3) + "]"; }
};

/** Draws two coordinates with axes of equal scale. */
void drawView(const RunEvaluation& run, const std::string& name, const std::string& title,
              Eigen::Index upward, Gnuplot& gnuplot) {
  constexpr double kMargin = 1.06, kFlattest = 0.25, kSteepest = 1.2, kPlotWidth = 900;
  Extent x, y;
  for (const RobotEvaluation& robot : run.trajectories->robots)
    for (const JoinedPose& pose : robot.poses)
      for (const Pose3& T : {pose.truth, robot.truth_T_world * pose.estimate}) {
        x.add(T.translation().x());
        y.add(T.translation()[upward]);
      }
  const double length = kMargin * std::max({x.length(), y.length() / kSteepest, 1.0});
  x.growTo(length);
  y.growTo(std::max(kFlattest * length, kMargin * y.length()));
  const int height = static_cast<int>(kPlotWidth * y.length() / x.length()) + 130;
  gnuplot.draw(name, 1200, height,
               titleOf(run, title) + "set size ratio -1\nset xlabel 'x [m]'\nset ylabel '" +
                   (upward == 1 ? "y" : "z") + " [m]'\nset xrange " + x.range() + "\nset yrange " +
                   y.range() + "\n" +
                   viewScript(*run.trajectories, name + ".dat", upward == 1 ? "1:2" : "1:3"),
               positions(*run.trajectories));
}

double largest(const std::vector<double>& values) {
  return values.empty() ? 0 : *std::max_element(values.begin(), values.end());
}

}  // namespace

std::string titleOf(const RunEvaluation& run, const std::string& what) {
  return "set title " +
         Gnuplot::quoted(what + ": " + run.name + ", alignment " +
                         toString(run.trajectories->alignment)) +
         "\n";
}

bool needsLogarithm(double small_max, double large_max) {
  constexpr double kFlat = 20.0;
  return small_max > 0 && large_max > kFlat * small_max;
}

void drawTrajectories(const RunEvaluation& run, const std::string& prefix, Gnuplot& gnuplot) {
  drawView(run, prefix + "trajectories_top", "Seen from above", 1, gnuplot);
  drawView(run, prefix + "trajectories_side", "Seen from the side", 2, gnuplot);
}

void drawErrorOverDistance(const RunEvaluation& run, const std::string& prefix, Gnuplot& gnuplot) {
  const TrajectoryEvaluation& all = *run.trajectories;
  const std::string name = prefix + "error_over_distance";
  std::string data, lines;
  size_t block = 0;
  const auto add = [&](const TrajectoryError& error, size_t robot, const std::string& what,
                       const char* style) {
    if (error.position_m.empty()) return;
    appendErrors(error, what, data);
    lines += std::string(lines.empty() ? "" : ", \\\n") + "  '" + name + ".dat' index " +
             std::to_string(block++) + " using 1:2 with lines " + style + " lc rgb " +
             lineColor(robot) + " title " + Gnuplot::quoted(what);
  };
  for (size_t i = 0; i < all.robots.size(); ++i) {
    add(all.robots[i].result.error, i, all.robots[i].name, "lw 3");
    add(all.robots[i].odometry.error, i, all.robots[i].name + ", odometry", "lw 2 dt 2");
  }
  const bool logarithm =
      needsLogarithm(largest(all.result.error.position_m), largest(all.odometry.error.position_m));
  gnuplot.draw(name, 1200, 700,
               titleOf(run, "Position error") +
                   (logarithm ? kLogarithmicError : "set yrange [0:*]\n") +
                   "set xlabel 'distance travelled [m]'\nset ylabel 'position error [m]'\n"
                   "plot \\\n" +
                   lines + "\n",
               data);
}

}  // namespace lamp::evaluation
