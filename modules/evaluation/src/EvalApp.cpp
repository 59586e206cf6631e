#include "lamp/evaluation/EvalApp.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "MarkdownTable.h"
#include "Pictures.h"
#include "ReportJson.h"
#include "lamp/core/Files.h"
#include "lamp/core/Program.h"
#include "lamp/core/Progress.h"
#include "lamp/core/Version.h"

namespace lamp::evaluation {

namespace {

struct Arguments {
  std::vector<std::string> runs;
  std::string truth;
  std::string align = toString(Alignment::kNone);
  std::string relations, stamps;
  std::string out, json;
  bool no_pictures = false;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Compares runs of lamp-slam with the truth: trajectories, loop closures, maps.\n"
      "Example: lamp-eval run1 run2 --truth world1 --out comparison");
  app.set_version_flag("--version", std::string("lamp-eval ") + kVersion);
  app.add_option("runs", arguments.runs, "Run folders of lamp-slam")->type_name("RUN")->required();
  app.add_option("--truth", arguments.truth, "Folder with <robot>.tum and map.ply")
      ->type_name("DIR");
  app.add_option("--align", arguments.align,
                 "How a run is aligned with the truth: none, first, team, se3")
      ->capture_default_str()
      ->check(CLI::IsMember({"none", "first", "team", "se3"}));
  app.add_option("--relations", arguments.relations, "True motions between scans")
      ->type_name("FILE");
  app.add_option("--stamps", arguments.stamps,
                 "The stamps that --relations use: number, their stamp, stamp in the rawlog")
      ->type_name("FILE");
  app.add_option("--out", arguments.out,
                 "Folder for tables and pictures; RUN/evaluation for a single run")
      ->type_name("DIR");
  app.add_option("--json", arguments.json, "Writes the figures there too; - for stdout")
      ->type_name("FILE");
  app.add_flag("--no-pictures", arguments.no_pictures, "Only figures");
}

/** \throws UsageError for a combination of options that makes no sense. */
void checkUse(const Arguments& arguments) {
  if (arguments.truth.empty() && arguments.relations.empty())
    throw UsageError("name what to compare with: --truth DIR, or --relations FILE --stamps FILE");
  if (arguments.relations.empty() != arguments.stamps.empty())
    throw UsageError("--relations and --stamps go together");
  if (arguments.runs.size() > 1 && arguments.out.empty())
    throw UsageError("name the folder for a comparison of several runs: --out DIR");
}

/** Names of the runs' folders; whole paths where those are not unique. */
std::vector<std::string> runNames(const std::vector<std::string>& runs) {
  const auto nameOf = [](const std::string& run) {
    const auto path = std::filesystem::absolute(run).lexically_normal();
    return (path.has_filename() ? path : path.parent_path()).filename().string();
  };
  std::vector<std::string> names;
  for (const std::string& run : runs) names.push_back(nameOf(run));
  for (size_t i = 0; i < names.size(); ++i)
    if (std::count(names.begin(), names.end(), nameOf(runs[i])) > 1) names[i] = runs[i];
  return names;
}

EvaluationInput inputOf(const Arguments& arguments) {
  EvaluationInput input;
  if (!arguments.truth.empty()) {
    input.truth.emplace(arguments.truth);
    input.world = TrueWorld::open(*input.truth);
  }
  input.relations = arguments.relations;
  input.scan_stamps = arguments.stamps;
  input.alignment = alignmentFromText(arguments.align);
  return input;
}

void writeErrorMaps(const std::vector<RunEvaluation>& runs, const std::string& out) {
  for (size_t i = 0; i < runs.size(); ++i)
    for (const MapEvaluation& map : runs[i].maps)
      writeErrorPly(out + "/" + filePrefix(runs, i) + map.name + "_error.ply", map,
                    errorScale(map));
}

std::vector<RunEvaluation> evaluateRuns(const Arguments& arguments, const EvaluationInput& input) {
  const auto names = runNames(arguments.runs);
  std::vector<RunEvaluation> runs;
  Progress progress;
  for (size_t i = 0; i < names.size(); ++i) {
    const auto show = [&](double share, const std::string& part) {
      progress.show((static_cast<double>(i) + share) / static_cast<double>(names.size()),
                    names[i] + ": " + part);
    };
    runs.push_back(evaluateRun(arguments.runs[i], input, show));
    runs.back().name = names[i];
  }
  return runs;
}

void run(const Arguments& arguments) {
  checkUse(arguments);
  const EvaluationInput input = inputOf(arguments);
  const std::string out =
      arguments.out.empty() ? arguments.runs.front() + "/evaluation" : arguments.out;
  const auto runs = evaluateRuns(arguments, input);
  const auto report = reportJson(runs, input);
  const std::string markdown = markdownReport(report), json = report.dump(2) + "\n";
  std::filesystem::create_directories(out);
  writeTextFile(out + "/evaluation.md", markdown);
  writeTextFile(out + "/evaluation.json", json);
  if (!arguments.json.empty() && arguments.json != "-") writeTextFile(arguments.json, json);
  writeErrorMaps(runs, out);
  if (!arguments.no_pictures)
    for (const std::string& warning : drawPictures(runs, out + "/plots"))
      std::cerr << "lamp-eval: " << warning << "\n";
  std::cout << (arguments.json == "-" ? json : markdown);
}

}  // namespace

int evalApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-eval");
  describe(app, arguments);
  return runProgram(app, argc, argv, [&] { run(arguments); });
}

}  // namespace lamp::evaluation
