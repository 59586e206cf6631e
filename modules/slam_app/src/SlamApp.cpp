#include "lamp/slam_app/SlamApp.h"

#include <CLI/CLI.hpp>
#include <atomic>
#include <iostream>
#include <limits>
#include <thread>

#include "RunLogging.h"
#include "lamp/core/Program.h"
#include "lamp/core/Version.h"
#include "lamp/slam_app/SlamRun.h"

namespace lamp {

namespace {

std::atomic<bool> interrupted{false};

struct Arguments {
  std::string config;
  std::vector<std::string> rawlogs;
  std::string out;
  std::vector<std::string> overrides;
  std::string actions;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  int seed = -1;
  std::string log = "WARN";
  bool list_modules = false;
  bool dump_config = false;
  bool dump_parameters = false;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Multi-robot lidar SLAM: rawlogs in, one optimised map out.\n"
      "Example: lamp-slam ini/default.ini robot1.rawlog robot2.rawlog --out run1");
  app.set_version_flag("--version", std::string("lamp-slam ") + kVersion);
  app.add_option("config", arguments.config, "Experiment file (see ini/)")->type_name("CONFIG.ini");
  app.add_option("rawlogs", arguments.rawlogs, "Recordings, in addition to those the ini names")
      ->type_name("RAWLOG");
  app.add_option("--out", arguments.out, "Folder for the results; new or empty")->type_name("DIR");
  app.add_option("--set", arguments.overrides, "Overrides one key of the ini")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--actions", arguments.actions,
                 "Operator's actions to replay, as a run's own actions.csv")
      ->type_name("FILE.csv");
  app.add_option("--threads", arguments.threads,
                 "Threads for registration; results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(1, 1024));
  app.add_option("--seed", arguments.seed, "Overrides run.seed")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()));
  app.add_option("--log", arguments.log, "Log level: DEBUG, INFO, WARN, ERROR")
      ->capture_default_str()
      ->check(CLI::IsMember({"DEBUG", "INFO", "WARN", "ERROR"}));
  app.add_flag("--list-modules", arguments.list_modules, "Lists the stages that an ini can name");
  app.add_flag("--dump-config", arguments.dump_config, "Prints the complete ini that would be run");
  app.add_flag("--dump-parameters", arguments.dump_parameters,
               "Prints all sections and keys as Markdown");
}

SlamConfig readConfig(const Arguments& arguments) {
  std::vector<std::string> overrides = arguments.overrides;
  if (arguments.seed >= 0) overrides.push_back("run.seed=" + std::to_string(arguments.seed));
  return SlamConfig::fromFile(arguments.config, overrides, arguments.rawlogs);
}

/** \return whether the arguments ask for information only, which is printed. */
bool inform(const Arguments& arguments) {
  if (arguments.dump_parameters) {
    std::cout << describeParameters();
    return true;
  }
  if (arguments.list_modules && arguments.config.empty()) {
    std::cout << listStages();
    return true;
  }
  return false;
}

void run(const Arguments& arguments) {
  registerAllClasses_lamp();
  if (inform(arguments)) return;
  if (arguments.config.empty())
    throw UsageError(
        "name an ini, for example: lamp-slam ini/default.ini RAWLOG --out DIR\n"
        "Run with --help for all options.");
  SlamConfig config = readConfig(arguments);
  // After reading, which may have loaded plugins with further stages.
  if (arguments.list_modules || arguments.dump_config) {
    std::cout << (arguments.list_modules ? listStages() : config.text());
    return;
  }
  if (arguments.out.empty()) throw UsageError("name the folder for the results: --out DIR");
  SlamRun::Job job{arguments.out, arguments.threads, {}};
  if (!arguments.actions.empty()) job.actions = readActions(arguments.actions);
  SlamRun slam(std::move(config), std::move(job), interrupted);
  slam.setMinLoggingLevel(kLogLevels.at(arguments.log));
  const SlamRun::Outcome outcome = runLogged(slam);
  std::cout << outcome.text;
  requireAllWritten(outcome, arguments.out);
}

}  // namespace

int slamApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-slam");
  describe(app, arguments);
  return runProgram(
      app, argc, argv, [&] { run(arguments); }, &interrupted);
}

}  // namespace lamp
