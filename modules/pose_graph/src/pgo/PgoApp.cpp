#include "lamp/pose_graph/PgoApp.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <limits>

#include "lamp/core/Files.h"
#include "lamp/core/G2oFile.h"
#include "lamp/core/Program.h"
#include "lamp/core/Version.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/pose_graph/ChanceAgreement.h"
#include "lamp/pose_graph/FalseLoops.h"
#include "pgo/PgoReport.h"
#include "pgo/StatedErrors.h"

namespace lamp {

namespace {

struct Arguments {
  std::string graph, config, out, json, covariances;
  std::string odometry_edges = toString(OdometryRule::kAuto);
  double add_outliers = 0;
  int seed = 1;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Robust optimisation of a pose graph in g2o's format.\n"
      "Example: lamp-pgo graph.g2o --out optimised.g2o --json report.json");
  app.set_version_flag("--version", std::string("lamp-pgo ") + kVersion);
  app.add_option("graph", arguments.graph, "Pose graph, SE2 or SE3")
      ->type_name("GRAPH.g2o")
      ->required();
  app.add_option("--config", arguments.config,
                 "Experiment file of lamp-slam, from which only the back end is used")
      ->type_name("CONFIG.ini");
  app.add_option("--out", arguments.out, "The optimised graph, without the rejected loop closures")
      ->type_name("OUT.g2o")
      ->required();
  app.add_option("--odometry-edges", arguments.odometry_edges,
                 "Which edges are odometry, which is never rejected: between successive ids (ids), "
                 "from id to id + 1 (next), between successive VERTEX lines (vertices), along the "
                 "file's edges (edges), or as listed in a FILE, a pair of ids a line; auto: ids, "
                 "or the better of vertices and edges if ids chain few nodes")
      ->type_name("RULE|FILE")
      ->capture_default_str();
  app.add_option(
         "--add-outliers", arguments.add_outliers,
         "Adds false loop closures until they make up this share of all, and reports precision and "
         "recall")
      ->type_name("SHARE")
      ->check(CLI::Range(0.0, 0.99));
  app.add_option("--seed", arguments.seed, "Seed of the false loop closures")
      ->capture_default_str()
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app.add_option("--json", arguments.json,
                 "Writes all figures, and each edge's weight, verdict and chi2; - for stdout")
      ->type_name("FILE");
  app.add_option("--covariances", arguments.covariances,
                 "Writes the covariance of each node's pose at the solution")
      ->type_name("FILE.csv");
}

/** The back end's part of `[pipeline]`; the other keys are lamp-slam's. */
struct PipelineOptions {
  std::vector<std::string> outlier_rejection = {"OdometryGate", "ChanceAgreement", "RobotFrames"};
  std::string optimizer = "Gnc";

  void visit(OptionVisitor& v) {
    v("outlier_rejection", outlier_rejection, "");
    v("optimizer", optimizer, "");
  }
};

BackEnd makeBackEnd(const std::string& config) {
  Faults faults;
  const Ini ini = config.empty() ? Ini() : Ini::fromFile(config, faults);
  PipelineOptions pipeline;
  IniOptionReader reader(ini.find("pipeline"), faults);
  pipeline.visit(reader);
  const std::string where = config + ": [pipeline] ";
  BackEnd back_end;
  for (const std::string& name : pipeline.outlier_rejection)
    back_end.rejections.push_back(makeStage<OutlierRejection>(
        StageName::parse(name), "outlier rejection", where + "outlier_rejection", ini, faults));
  back_end.optimizer = makeStage<Optimizer>(StageName::parse(pipeline.optimizer), "optimizer",
                                            where + "optimizer", ini, faults);
  faults.throwIfAny();
  return back_end;
}

/** What agrees by chance can only be told if the size of errors is known. */
void leaveChanceOut(G2oGraph& g2o, BackEnd& back_end) {
  const bool is_identity = g2o.information == InformationKind::kIdentity;
  if (!is_identity &&
      !(g2o.information == InformationKind::kConstant && overstatesErrors(g2o.graph)))
    return;
  auto& stages = back_end.rejections;
  const auto judgesChance = [](const std::shared_ptr<OutlierRejection>& stage) {
    return std::dynamic_pointer_cast<ChanceAgreement>(stage) != nullptr;
  };
  stages.erase(std::remove_if(stages.begin(), stages.end(), judgesChance), stages.end());
  g2o.notes.push_back(
      std::string("the information ") +
      (is_identity ? "is the identity in all edges and says nothing about their errors"
                   : "is the same in all edges, and loop closures agree with odometry far better "
                     "than it suggests") +
      ": ChanceAgreement takes no part, and only loop closures that contradict others are "
      "rejected");
}

void run(const Arguments& arguments) {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_pose_graph();
  BackEnd back_end = makeBackEnd(arguments.config);
  G2oGraph g2o = readG2oFile(arguments.graph, odometryEdgesFrom(arguments.odometry_edges));
  const size_t true_edges = g2o.graph.edges().size();
  addFalseLoops(g2o.graph, arguments.add_outliers, static_cast<unsigned>(arguments.seed));
  leaveChanceOut(g2o, back_end);

  const OptimizationResult result = back_end.optimize(g2o.graph);
  const auto report = pgoReport(g2o, result, true_edges);
  if (!arguments.json.empty() && arguments.json != "-")
    writeTextFile(arguments.json, report.dump(1) + "\n");
  if (!result.report.usable)
    throw std::runtime_error("the optimisation failed: " + result.report.termination);
  applyResult(result, g2o.graph);
  writeTextFile(arguments.out, toG2o(g2o));
  if (!arguments.covariances.empty())
    writeTextFile(arguments.covariances, covarianceTable(g2o).text());
  std::cout << (arguments.json == "-" ? report.dump(1) + "\n" : pgoSummary(report)) << std::flush;
  if (!report["success"])
    throw std::runtime_error("less than a tenth of the loop closures were kept, so " +
                             arguments.out +
                             " rests on odometry alone; check what was taken for odometry "
                             "(--odometry-edges) and the information matrices");
}

}  // namespace

int pgoApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-pgo");
  describe(app, arguments);
  return runProgram(app, argc, argv, [&] { run(arguments); });
}

}  // namespace lamp
