#include "lamp/simulation/SimApp.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <thread>

#include "lamp/core/Program.h"
#include "lamp/core/Version.h"
#include "lamp/simulation/SimRun.h"

namespace lamp::simulation {

namespace {

struct Arguments {
  std::string world;
  std::string config;
  std::vector<std::string> overrides;
  SimJob job;
  bool keyed = false;
  bool dump_config = false;
};

std::string describeWorlds() {
  std::string text = "Worlds:\n";
  for (const WorldKind& kind : worldKinds()) {
    double length = 0;
    for (const PaperRobot& robot : kind.robots) length += robot.length_m;
    text += "  " + kind.name + ": " + kind.meaning + "; " + std::to_string(kind.robots.size()) +
            " robots, " + std::to_string(static_cast<int>(length)) + " m\n";
  }
  return text;
}

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Makes recordings of robots in an underground world, with the truth beside them.\n"
      "Example: lamp-sim demo --seed 1 --out demo-world");
  app.footer(describeWorlds());
  app.set_version_flag("--version", std::string("lamp-sim ") + kVersion);
  app.add_option("world", arguments.world, "Kind of world")->type_name("WORLD")->required();
  app.add_option("--seed", arguments.job.seed, "Another seed, another world of the kind")
      ->capture_default_str();
  app.add_option("--out", arguments.job.out, "Folder for the results; new or empty")
      ->type_name("DIR");
  app.add_option("--config", arguments.config, "Ini with changes (see --dump-config)")
      ->type_name("FILE.ini");
  app.add_option("--set", arguments.overrides, "Changes one key, e.g. world.robots=8")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  auto* keyed = app.add_flag("--keyed", arguments.keyed,
                             "Key nodes only: deskewed, merged, filtered scans (the default)");
  app.add_flag("--raw", arguments.job.raw, "All observations at full rate")->excludes(keyed);
  arguments.job.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  app.add_option("--threads", arguments.job.threads, "Results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  app.add_flag("--dump-config", arguments.dump_config,
               "Prints the complete ini that would be used");
}

SimConfig readConfig(const Arguments& arguments) {
  Faults faults;
  Ini ini;
  if (!arguments.config.empty()) ini = Ini::fromFile(arguments.config, faults);
  for (const std::string& assignment : arguments.overrides) ini.set(assignment, faults);
  return SimConfig(worldKind(arguments.world), ini, std::move(faults));
}

void run(const Arguments& arguments) {
  const SimConfig config = readConfig(arguments);
  if (arguments.dump_config) {
    std::cout << config.text();
    return;
  }
  if (arguments.job.out.empty()) throw UsageError("name the folder for the results: --out DIR");
  std::cout << simulate(config, arguments.job);
}

}  // namespace

int simApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-sim");
  describe(app, arguments);
  return runProgram(app, argc, argv, [&] { run(arguments); });
}

}  // namespace lamp::simulation
