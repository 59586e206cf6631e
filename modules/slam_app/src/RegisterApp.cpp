#include "lamp/slam_app/RegisterApp.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "PairRegistration.h"
#include "RegisterReport.h"
#include "lamp/core/Files.h"
#include "lamp/core/Program.h"
#include "lamp/core/Version.h"
#include "lamp/maps/RegistrationPicture.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {

namespace {

struct Arguments {
  std::string source, target;
  std::string config;
  std::vector<std::string> overrides;
  std::string json, picture;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Registers two point clouds as lamp-slam registers a loop closure, and says what each stage "
      "made of them.\n"
      "Example: lamp-register scan1.pcd scan2.pcd --picture pair.png");
  app.set_version_flag("--version", std::string("lamp-register ") + kVersion);
  app.add_option("source", arguments.source, "Cloud to be moved: PLY or PCD")
      ->type_name("SOURCE")
      ->required();
  app.add_option("target", arguments.target, "Cloud to move it onto: PLY or PCD")
      ->type_name("TARGET")
      ->required();
  app.add_option("--config", arguments.config,
                 "Experiment file (see ini/); without one, the defaults with Teaser and PlanarSearch as the aligners")
      ->type_name("CONFIG.ini");
  app.add_option("--set", arguments.overrides, "Overrides one key of the ini")
      ->type_name("SECTION.KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--json", arguments.json, "Writes the result as JSON; - for stdout")
      ->type_name("FILE");
  app.add_option("--picture", arguments.picture, "Draws both clouds before and after, as PNG")
      ->type_name("FILE");
}

/** Without an ini no graph gives a guess, so the aligner must need none. */
SlamConfig readConfig(const Arguments& arguments) {
  if (!arguments.config.empty()) return SlamConfig::fromFile(arguments.config, arguments.overrides);
  Faults faults;
  Ini ini;
  ini.set("pipeline", "initial_aligner", "Teaser, PlanarSearch", "lamp-register");
  for (const std::string& assignment : arguments.overrides) ini.set(assignment, faults);
  return SlamConfig(std::move(ini), std::move(faults));
}

PicturedCloud pictured(const RegisteredCloud& cloud) {
  std::string name = std::filesystem::path(cloud.path).filename().string();
  if (!cloud.offset.isZero()) name += " less " + offsetText(cloud);
  return {std::move(name), cloud.scan->points};
}

void draw(const PairRegistration& pair, const std::string& path) {
  RegistrationPicture picture{pictured(pair.source), pictured(pair.target), {}, false, ""};
  if (pair.hasResult()) picture.target_T_source = pair.attempt.result.target_T_source;
  picture.accepted = pair.attempt.accepted;
  picture.verdict = pair.verdict();
  writeRegistrationPicture(path, picture);
}

void run(const Arguments& arguments) {
  registerAllClasses_lamp();
  const SlamConfig config = readConfig(arguments);
  const PairRegistration pair = registerPair(arguments.source, arguments.target, config);
  const std::string json = registerJson(pair).dump(2) + "\n";
  const bool json_only = arguments.json == "-";
  std::cout << (json_only ? json : registerReport(pair));
  if (!arguments.json.empty() && !json_only) writeTextFile(arguments.json, json);
  if (!arguments.picture.empty()) draw(pair, arguments.picture);
}

}  // namespace

int registerApp(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("", "lamp-register");
  describe(app, arguments);
  return runProgram(app, argc, argv, [&] { run(arguments); });
}

}  // namespace lamp
