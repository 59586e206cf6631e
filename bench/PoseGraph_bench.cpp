// The back end beside a straightforward Ceres problem: automatic derivatives,
// SPARSE_NORMAL_CHOLESKY and default options. The counter `ratio` is our time over that of Ceres
// for the outlier-free graph, both of this run. Recorded graphs come from LAMP_DATA, or
// ../shared/data; where they are missing, only the simulated one is there. One thread.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>

#include "CeresAutoDiff.h"
#include "TestGraphs.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/pose_graph/ChanceAgreement.h"
#include "lamp/pose_graph/FalseLoops.h"
#include "lamp/core/G2oFile.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/OdometryGate.h"
#include "lamp/pose_graph/PlainOptimizers.h"

namespace lamp {
namespace {

/** Seconds of the processor, so that other programs do not count; the least of three times. */
template <class Work>
double seconds(const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const std::clock_t start = std::clock();
    work();
    least = std::min(least, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  return least;
}

/** A graph whose estimates are the odometry chain, what Ceres needs for it, and its optimum. */
struct Subject {
  explicit Subject(PoseGraph subject) : graph(std::move(subject)) {
    const std::vector<Pose3> guess = initialGuess(graph);
    for (size_t i = 0; i < guess.size(); ++i)
      graph.node(graph.nodes()[i].id).world_T_base = guess[i];
    ceres_s = seconds([&] { ceres_cost = solveWithAutoDiff(graph, {}); });
    optimum = Lm().optimize(graph);
  }

  double ate(const std::vector<Pose3>& poses) const {
    double sum = 0;
    for (size_t i = 0; i < poses.size(); ++i)
      sum += (poses[i].translation() - optimum.world_T_base[i].translation()).squaredNorm();
    return std::sqrt(sum / static_cast<double>(poses.size()));
  }

  PoseGraph graph;
  double ceres_s = 0, ceres_cost = 0;
  OptimizationResult optimum;
};

/** A recorded graph, held at its first key node. \param loops kept at random; 0 keeps all. */
PoseGraph recorded(const std::string& name, size_t loops) {
  const G2oGraph file = readG2oFile(dataFolder() + "/pose_graphs/" + name + ".g2o");
  PoseGraph graph;
  for (const Node& node : file.graph.nodes()) graph.addNode(node);
  const KeyNodeId first = file.graph.nodes().front().id;
  graph.addEdge(
      makeEdge(EdgeType::kPrior, first, first, Pose3::Identity(), informationOf(1e-3, 1e-3)));
  std::vector<Edge> closures;
  for (const Edge& edge : file.graph.edges())
    if (edge.mayBeRejected())
      closures.push_back(edge);
    else
      graph.addEdge(edge);
  if (loops > 0 && loops < closures.size()) {
    Random random(1);
    for (size_t i = 0; i < loops; ++i)
      std::swap(closures[i], closures[i + random.below(closures.size() - i)]);
    closures.resize(loops);
  }
  for (const Edge& edge : closures) graph.addEdge(edge);
  return graph;
}

PoseGraph simulated(bool planar) {
  WorldOptions options;
  options.robots = 3;
  options.nodes = 600;
  options.loops = 600;
  options.planar = planar;
  return makeWorld(options).graph;
}

using Maker = std::function<PoseGraph()>;

const Subject& subject(const std::string& name, const Maker& make) {
  static std::map<std::string, std::unique_ptr<Subject>> made;
  auto& found = made[name];
  if (!found) found = std::make_unique<Subject>(make());
  return *found;
}

/** Time an iteration is that of the state's loop; the ratio is taken here. */
template <class Work>
void compare(benchmark::State& state, const Subject& with, const Work& work) {
  for (auto _ : state) work();
  state.counters["ratio"] = seconds(work) / with.ceres_s;
  state.counters["ceres_ms"] = 1e3 * with.ceres_s;
}

void plain(benchmark::State& state, const std::string& name, const Maker& make) {
  const Subject& with = subject(name, make);
  OptimizationResult result;
  compare(state, with, [&] { result = Lm().optimize(with.graph); });
  state.counters["cost_over_ceres"] = result.report.final_cost / with.ceres_cost;
}

BackEnd backEnd(const Gnc& gnc) {
  return {{std::make_shared<OdometryGate>(), std::make_shared<ChanceAgreement>()},
          std::make_shared<Gnc>(gnc)};
}

void robust(benchmark::State& state, const std::string& name, const Maker& make) {
  const Subject& with = subject(name, make);
  PoseGraph graph = with.graph;
  addFalseLoops(graph, static_cast<double>(state.range(0)) / 100.0, 1);
  OptimizationResult result;
  compare(state, with, [&] {
    // A new one each time: it would remember the solution.
    result = backEnd(Gnc()).optimize(graph);
  });
  double kept = 0, right = 0, all = 0;
  for (const LoopVerdict& loop : result.loops) {
    const bool is_true = loop.edge < with.graph.edges().size();
    kept += loop.verdict == Verdict::kInlier;
    all += is_true;
    right += is_true && loop.verdict == Verdict::kInlier;
  }
  state.counters["precision"] = right / kept;
  state.counters["recall"] = right / all;
  state.counters["ate_m"] = with.ate(result.world_T_base);
}

/** A graph, and the same after one more key node and ten loops. */
struct Growth {
  PoseGraph before, after;
};

/** 3000 key nodes and 2000 loops, of which a share is false; so are those that come. */
Growth grow(bool planar, double share) {
  constexpr size_t kLoops = 2000, kNewLoops = 10;
  WorldOptions options;
  options.robots = 3;
  options.nodes = 1000;
  options.loops = static_cast<int>((1 - share) * kLoops);
  options.outliers = static_cast<int>(share * kLoops);
  options.planar = planar;
  const PoseGraph world = makeWorld(options).graph;
  std::vector<Edge> loops;
  for (const Edge& edge : world.edges())
    if (edge.isLoopClosure()) loops.push_back(edge);
  Random random(1);
  for (size_t i = 0; i < loops.size(); ++i)
    std::swap(loops[i], loops[i + random.below(loops.size() - i)]);
  const KeyNodeId newest = world.nodes().back().id;
  const auto touchesNewest = [&](const Edge& e) { return e.from == newest || e.to == newest; };
  std::stable_partition(loops.begin(), loops.end(),
                        [&](const Edge& edge) { return !touchesNewest(edge); });
  Growth growth;
  for (const Node& node : world.nodes())
    if (!(node.id == newest)) growth.before.addNode(node);
  for (const Edge& edge : world.edges())
    if (!edge.isLoopClosure() && !touchesNewest(edge)) growth.before.addEdge(edge);
  for (size_t i = 0; i + kNewLoops < loops.size(); ++i) growth.before.addEdge(loops[i]);
  growth.after = growth.before;
  growth.after.addNode(world.nodes().back());
  for (const Edge& edge : world.edges())
    if (!edge.isLoopClosure() && touchesNewest(edge)) growth.after.addEdge(edge);
  for (size_t i = loops.size() - kNewLoops; i < loops.size(); ++i) growth.after.addEdge(loops[i]);
  return growth;
}

/** An update beside a cold solve of the same graph. */
void online(benchmark::State& state, bool planar) {
  const Growth growth = grow(planar, static_cast<double>(state.range(0)) / 100.0);
  Gnc warm;
  {
    const BackEnd first = backEnd(Gnc());
    first.optimize(growth.before);
    warm = dynamic_cast<const Gnc&>(*first.optimizer);
  }
  for (auto _ : state) backEnd(warm).optimize(growth.after);
  const double cold = seconds([&] { backEnd(Gnc()).optimize(growth.after); });
  state.counters["over_cold"] = seconds([&] { backEnd(warm).optimize(growth.after); }) / cold;
  state.counters["cold_ms"] = 1e3 * cold;
}

void registerGraph(const std::string& name, const Maker& make) {
  const auto add = [&](const char* kind, auto* bench) {
    return benchmark::RegisterBenchmark((std::string(kind) + "/" + name).c_str(), bench, name, make)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  };
  add("Lm", plain);
  add("GncOutlierPercent", robust)->Arg(0)->Arg(20)->Arg(50)->Arg(80);
}

}  // namespace
}  // namespace lamp

int main(int argc, char** argv) {
  using namespace lamp;
  registerGraph("simulated3d", [] { return simulated(false); });
  registerGraph("simulated2d", [] { return simulated(true); });
  if (!dataFolder().empty()) {
    for (const char* name : {"kitti_00", "intel", "CSAIL", "MIT"})
      registerGraph(name, [name] { return recorded(name, 0); });
    registerGraph("parking-garage-200", [] { return recorded("parking-garage", 200); });
    benchmark::RegisterBenchmark("Lm/parking-garage", plain, std::string("parking-garage"),
                                 Maker([] { return recorded("parking-garage", 0); }))
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
  }
  for (const bool planar : {false, true})
    benchmark::RegisterBenchmark(planar ? "OnlineOutlierPercent/2d" : "OnlineOutlierPercent/3d",
                                 online, planar)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1)
        ->Arg(0)
        ->Arg(20)
        ->Arg(50);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
