// The sparse Cholesky factorisation beside CHOLMOD (SuiteSparse) in the same run, on the normal
// equations at the odometry chain: recorded graphs from LAMP_DATA, or ../shared/data, and grid
// worlds in space. Milliseconds of the processor, the least of some times; `ratio` is ours over
// CHOLMOD's. One thread: set OPENBLAS_NUM_THREADS=1 if the BLAS has threads of its own.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <functional>
#include <limits>

#include "Cholmod.h"
#include "GridWorld.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "solver/NormalEquations.h"
#include "solver/SelectedInverse.h"

namespace lamp {
namespace {

constexpr double kDamping = 1e-6;

template <class Work>
double milliseconds(const Work& work) {
  double least = std::numeric_limits<double>::infinity(), sum = 0;
  for (int i = 0; i < 20 && sum < 2000; ++i) {
    const std::clock_t start = std::clock();
    work();
    const double took = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    least = std::min(least, took);
    sum += took;
  }
  return least;
}

template <class Space>
BlockMatrix<Space::kDof> equations(const PoseGraph& graph) {
  const std::vector<PoseTerm<Space>> terms = poseTerms<Space>(graph);
  const std::vector<double> weights(terms.size(), 1.0);
  std::vector<typename Space::Pose> poses;
  for (const Node& node : graph.nodes()) poses.push_back(Space::fromPose3(node.world_T_base));
  NormalEquations<Space> equations(terms, findUnknowns(graph, weights));
  equations.linearize(poses);
  BlockMatrix<Space::kDof> matrix = equations.matrix();
  for (size_t row = 0; row < matrix.diagonal.size(); ++row)
    matrix.diagonal[row].diagonal() += (kDamping * matrix.scale(row)).eval();
  return matrix;
}

template <class Space>
void compare(benchmark::State& state, const PoseGraph& graph) {
  const BlockMatrix<Space::kDof> matrix = equations<Space>(graph);
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(Space::kDof * matrix.diagonal.size());
  auto& counters = state.counters;
  std::unique_ptr<BlockCholesky<Space::kDof>> ours;
  counters["analyze_ms"] = milliseconds([&] {
    ours.reset();
    ours = std::make_unique<BlockCholesky<Space::kDof>>(matrix);
  });
  for (auto _ : state) ours->factorize(matrix, 0);
  const double factor = milliseconds([&] { ours->factorize(matrix, 0); });
  counters["factor_ms"] = factor;
  Eigen::VectorXd x;
  counters["solve_ms"] = milliseconds([&] { ours->solve(x = right); });
  counters["inverse_ms"] = milliseconds([&] { selectedInverse(*ours); });
  const double flops = 2e-9 * std::pow(Space::kDof, 3) * ours->symbolic().products();
  counters["gflop"] = flops;
  counters["gflops"] = 1e3 * flops / factor;
  ours.reset();

  Cholmod peer(matrix);
  counters["peer_analyze_ms"] = milliseconds([&] { peer.analyze(); });
  const double peer_factor = milliseconds([&] { peer.factorize(); });
  counters["peer_factor_ms"] = peer_factor;
  Eigen::VectorXd expected;
  counters["peer_solve_ms"] = milliseconds([&] { expected = peer.solve(right); });
  counters["peer_gflop"] = peer.gigaflops();
  counters["ratio"] = factor / peer_factor;
  counters["difference"] = (x - expected).norm() / expected.norm();
}

using Maker = std::function<PoseGraph()>;

void factorization(benchmark::State& state, const Maker& make) {
  const PoseGraph graph = make();
  if (graph.planar())
    compare<Se2>(state, graph);
  else
    compare<Se3>(state, graph);
}

/** A whole solve, from the odometry chain. */
void levenbergMarquardt(benchmark::State& state, const Maker& make) {
  const PoseGraph graph = make();
  OptimizationResult result;
  for (auto _ : state) result = Lm().optimize(graph);
  state.counters["iterations"] = result.report.iterations;
  state.counters["cost"] = result.report.final_cost;
}

void registerGraph(const std::string& name, const Maker& make) {
  for (const auto& [kind, bench] :
       {std::make_pair("Factor/", factorization), std::make_pair("Lm/", levenbergMarquardt)})
    benchmark::RegisterBenchmark((kind + name).c_str(), bench, make)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(1);
}

}  // namespace
}  // namespace lamp

int main(int argc, char** argv) {
  using namespace lamp;
  if (!dataFolder().empty())
    for (const std::string name : {"kitti_00", "intel", "CSAIL", "MIT", "parking-garage"})
      registerGraph(name,
                    [name] { return readG2o(dataFolder() + "/pose_graphs/" + name + ".g2o"); });
  for (const int poses : {2000, 5000, 20000, 50000})
    registerGraph("grid" + std::to_string(poses), [poses] { return GridWorld(poses).graph(); });
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
