// The back end with its default stages on recorded and synthetic graphs with false loops: what it
// keeps, how much work it takes beside a plain solve of the same graph without the false loops, and
// its truncated cost beside that of the plain solve. One line a run, as CSV. Of the wrong loops
// kept, `wrong_beyond` are those that the plain solution contradicts: the others agree with the
// truth within the errors that they state, by chance.
//
//   RobustComparison [--graphs NAME,...] [--false PERCENT,...] [--seed N]
//
// Recorded graphs come from LAMP_DATA, or ../shared/data.
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <set>
#include <sstream>

#include "SyntheticGraphs.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/core/G2oFile.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/pose_graph/ChanceAgreement.h"
#include "lamp/pose_graph/EdgeResiduals.h"
#include "lamp/pose_graph/FalseLoops.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/OdometryGate.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "lamp/pose_graph/RobotFrames.h"

namespace lamp {
namespace {

double processorSeconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/** The largest squared residual that Gnc lets an inlier have. */
double threshold(const PoseGraph& graph, EdgeIndex e) {
  int rank = 0;
  for (int i = 0; i < 6; ++i) rank += graph.edges()[e].information(i, i) > 0;
  if (graph.planar()) rank = std::min(rank, 3);
  return chiSquareQuantile(GncOptions().inlier_probability, rank);
}

/** Half the sum of squared residuals, those of loops at most the threshold that Gnc has. */
double truncatedCost(const PoseGraph& graph, const std::vector<double>& residuals2) {
  double sum = 0;
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    sum += graph.edges()[e].mayBeRejected() ? std::min(residuals2[e], threshold(graph, e))
                                            : residuals2[e];
  return 0.5 * sum;
}

/** RMS distance of positions after the best rigid motion. */
double ate(const std::vector<Pose3>& estimate, const std::vector<Eigen::Vector3d>& truth) {
  Eigen::Matrix3Xd from(3, truth.size()), to(3, truth.size());
  for (size_t i = 0; i < truth.size(); ++i) {
    from.col(static_cast<Eigen::Index>(i)) = estimate[i].translation();
    to.col(static_cast<Eigen::Index>(i)) = truth[i];
  }
  const Eigen::Matrix4d T = Eigen::umeyama(from, to, false);
  const Eigen::Matrix3Xd moved =
      (T.topLeftCorner<3, 3>() * from).colwise() + T.topRightCorner<3, 1>();
  return std::sqrt((moved - to).colwise().squaredNorm().mean());
}

struct Subject {
  PoseGraph graph;
  std::vector<bool> true_edge;
  std::vector<Eigen::Vector3d> truth;  ///< empty: the optimum of the true edges
};

Subject synthetic(const World& world) {
  Subject subject{world.graph, world.true_edge, {}};
  for (const Pose3& pose : world.truth) subject.truth.push_back(pose.translation());
  return subject;
}

/** \param loops kept at random; 0 keeps all. */
Subject recorded(const std::string& name, size_t loops) {
  PoseGraph graph = readG2oFile(dataFolder() + "/pose_graphs/" + name + ".g2o").graph;
  if (loops > 0) {
    PoseGraph thinned;
    for (const Node& node : graph.nodes()) thinned.addNode(node);
    std::vector<Edge> closures;
    for (const Edge& edge : graph.edges())
      if (edge.mayBeRejected())
        closures.push_back(edge);
      else
        thinned.addEdge(edge);
    Random random(1);
    for (size_t i = 0; i < loops; ++i)
      std::swap(closures[i], closures[i + random.below(closures.size() - i)]);
    for (size_t i = 0; i < loops; ++i) thinned.addEdge(closures[i]);
    graph = thinned;
  }
  return {graph, std::vector<bool>(graph.edges().size(), true), {}};
}

/** Real loops of place recognition, some of them false; positions are known. */
Subject places(const std::string& name) {
  const std::string base = dataFolder() + "/place_graphs/" + name;
  Subject subject{readG2oFile(base + ".g2o").graph, {}, {}};
  std::set<std::pair<uint64_t, uint64_t>> wrong;
  std::ifstream labels(base + ".labels");
  double similarity, distance;
  int is_false;
  for (uint64_t a, b; labels >> a >> b >> similarity >> distance >> is_false;)
    if (is_false != 0) wrong.insert(std::minmax(a, b));
  for (const Edge& edge : subject.graph.edges()) {
    const uint64_t a = edge.from.index, b = edge.to.index;
    subject.true_edge.push_back(!edge.isLoopClosure() || wrong.count(std::minmax(a, b)) == 0);
  }
  std::ifstream truth(base + ".truth.txt");
  for (std::string line; std::getline(truth, line);) {
    std::istringstream words(line);
    double id, stamp, x, y;
    if (words >> id >> stamp >> x >> y) subject.truth.emplace_back(x, y, 0);
  }
  return subject;
}

using Maker = std::function<Subject()>;

SyntheticOptions options(int robots, int nodes, double loops_a_node, unsigned seed) {
  SyntheticOptions result;
  result.robots = robots;
  result.nodes = nodes;
  result.loops_a_node = loops_a_node;
  result.seed = seed;
  return result;
}

std::vector<std::pair<std::string, Maker>> subjects(unsigned seed) {
  std::vector<std::pair<std::string, Maker>> list;
  for (const char* name : {"kitti_00", "intel", "CSAIL", "MIT", "parking-garage"})
    list.emplace_back(name, [=] { return recorded(name, 0); });
  list.emplace_back("parking-garage-200", [] { return recorded("parking-garage", 200); });
  for (const char* name : {"Corridor", "Lecture_Hall"})
    list.emplace_back(name, [=] { return places(name); });
  for (const bool planar : {false, true})
    list.emplace_back(planar ? "circles-planar" : "circles", [=] {
      WorldOptions of;
      of.robots = 3;
      of.nodes = of.loops = 600;
      of.planar = planar;
      return synthetic(makeWorld(of));
    });
  for (const double gap_share : {0.0, 0.07})
    for (const int nodes : {2000, 5750})
      list.emplace_back("grid-" + std::to_string(nodes) + (gap_share > 0 ? "-gaps" : ""), [=] {
        SyntheticOptions of = options(1, nodes, 2, seed);
        of.gap_share = gap_share;
        of.odometry_m = 0.05;
        of.odometry_rad = 0.01;
        return synthetic(makeGrid(of));
      });
  for (const double odometry_rad : {0.002, 0.008})
    list.emplace_back(odometry_rad > 0.005 ? "long-drive-vague" : "long-drive", [=] {
      SyntheticOptions of = options(1, 15000, 0.107, seed);
      of.odometry_rad = odometry_rad;
      return synthetic(makeLongDrive(of));
    });
  list.emplace_back("tunnels", [=] { return synthetic(makeTunnels(options(8, 450, 1, seed))); });
  list.emplace_back("tunnels-overconfident", [=] {
    SyntheticOptions of = options(8, 450, 1, seed);
    of.overconfidence = 6;
    return synthetic(makeTunnels(of));
  });
  // Odometry that drifts as gyroscopes do, and places that are taken for others.
  list.emplace_back("tunnels-hard", [=] {
    SyntheticOptions of = options(8, 450, 1, seed);
    of.odometry_bias_rad = 0.002;
    of.mistaken_places = 72;
    return synthetic(makeTunnels(of));
  });
  list.emplace_back("long-drive-hard", [=] {
    SyntheticOptions of = options(1, 15000, 0.107, seed);
    of.odometry_bias_rad = 0.0005;
    of.mistaken_places = 32;
    return synthetic(makeLongDrive(of));
  });
  list.emplace_back("grid-5750-pieces", [=] {
    SyntheticOptions of = options(1, 5750, 2, seed);
    of.pieces = 12;
    of.odometry_m = 0.05;
    of.odometry_rad = 0.01;
    return synthetic(makeGrid(of));
  });
  return list;
}

BackEnd defaultBackEnd() {
  return {{std::make_shared<OdometryGate>(), std::make_shared<ChanceAgreement>(),
           std::make_shared<RobotFrames>()},
          std::make_shared<Gnc>()};
}

/** Their relative poses are from the extent of the solution; the estimates stay as they are. */
PoseGraph withFalseLoops(PoseGraph graph, const std::vector<Pose3>& solution, int percent,
                         unsigned seed) {
  std::vector<Pose3> before;
  for (size_t i = 0; i < solution.size(); ++i) {
    Pose3& pose = graph.node(graph.nodes()[i].id).world_T_base;
    before.push_back(pose);
    pose = solution[i];
  }
  addFalseLoops(graph, percent / 100.0, seed);
  for (size_t i = 0; i < before.size(); ++i)
    graph.node(graph.nodes()[i].id).world_T_base = before[i];
  return graph;
}

void compare(const std::string& name, Subject subject, const std::vector<int>& percents,
             unsigned seed) {
  PoseGraph clean;
  for (const Node& node : subject.graph.nodes()) clean.addNode(node);
  for (EdgeIndex e = 0; e < subject.graph.edges().size(); ++e)
    if (subject.true_edge[e]) clean.addEdge(subject.graph.edges()[e]);
  PlainOptions plain_options;
  plain_options.start = "odometry";
  double start = processorSeconds();
  const OptimizationResult plain = Lm(plain_options).optimize(clean);
  const double plain_s = processorSeconds() - start;
  if (subject.truth.empty())
    for (const Pose3& pose : plain.world_T_base) subject.truth.push_back(pose.translation());
  const size_t edges = subject.graph.edges().size();
  for (const int percent : percents) {
    const PoseGraph graph = withFalseLoops(subject.graph, plain.world_T_base, percent, seed);
    start = processorSeconds();
    const OptimizationResult result = defaultBackEnd().optimize(graph);
    const double robust_s = processorSeconds() - start;
    const std::vector<double> residuals2 = edgeResiduals2(graph, result.world_T_base),
                              plain_residuals2 = edgeResiduals2(graph, plain.world_T_base);
    size_t all = 0, right = 0, wrong = 0, harmful = 0;
    for (const LoopVerdict& loop : result.loops) {
      const bool is_true = loop.edge < edges && subject.true_edge[loop.edge];
      all += is_true;
      if (loop.verdict != Verdict::kInlier) continue;
      ++(is_true ? right : wrong);
      harmful += !is_true && plain_residuals2[loop.edge] > threshold(graph, loop.edge);
    }
    std::printf(
        "%s,%d,%zu,%zu,%zu,%zu,%.4f,%.4f,%d,%d,%.3f,%.1f,%d,%.4g,%.4g,%.3g,%.3g,%.3g,%s\n",
        name.c_str(), percent, all, right, wrong, harmful,
        static_cast<double>(right) / static_cast<double>(std::max<size_t>(1, all)),
        static_cast<double>(right) / static_cast<double>(std::max<size_t>(1, right + wrong)),
        result.report.rounds, result.report.iterations, robust_s, robust_s / plain_s,
        plain.report.iterations, truncatedCost(graph, residuals2),
        truncatedCost(graph, plain_residuals2), ate(result.world_T_base, subject.truth),
        ate(plain.world_T_base, subject.truth), result.report.odometry_scale,
        result.report.termination.c_str());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace lamp

int main(int argc, char** argv) {
  using namespace lamp;
  std::vector<std::string> graphs;
  std::vector<int> percents = {0, 20, 50, 80};
  unsigned seed = 1;
  CLI::App app("", "RobustComparison");
  app.add_option("--graphs", graphs)->delimiter(',');
  app.add_option("--false", percents)->delimiter(',');
  app.add_option("--seed", seed);
  CLI11_PARSE(app, argc, argv);
  std::puts(
      "graph,false_percent,true_loops,right,wrong,wrong_beyond,recall,precision,rounds,iterations,"
      "seconds,"
      "over_plain,plain_iterations,truncated_cost,plain_truncated_cost,ate_m,plain_ate_m,"
      "odometry_scale,termination");
  for (const auto& [name, make] : subjects(seed))
    if (graphs.empty() || std::find(graphs.begin(), graphs.end(), name) != graphs.end())
      compare(name, make(), percents, seed);
}
