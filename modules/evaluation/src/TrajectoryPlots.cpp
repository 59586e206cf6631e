#include "TrajectoryPlots.h"

#include <algorithm>

#include "lamp/core/Csv.h"

namespace lamp {

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
  std::string script = "set key outside bottom center horizontal\nplot \\\n";
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
  const std::string data = positions(*run.trajectories);
  const std::string axes = "set size ratio -1\nset xlabel 'x [m]'\n";
  const std::string top = prefix + "trajectories_top", side = prefix + "trajectories_side";
  gnuplot.draw(top, 1200, 1000,
               titleOf(run, "Seen from above") + axes + "set ylabel 'y [m]'\n" +
                   viewScript(*run.trajectories, top + ".dat", "1:2"),
               data);
  gnuplot.draw(side, 1200, 700,
               titleOf(run, "Seen from the side") + axes + "set ylabel 'z [m]'\n" +
                   viewScript(*run.trajectories, side + ".dat", "1:3"),
               data);
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
                   (logarithm ? "set logscale y\n" : "set yrange [0:*]\n") +
                   "set xlabel 'distance travelled [m]'\nset ylabel 'position error [m]'\n"
                   "set key outside bottom center horizontal\nplot \\\n" +
                   lines + "\n",
               data);
}

}  // namespace lamp
