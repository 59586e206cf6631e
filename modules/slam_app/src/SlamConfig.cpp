#include "lamp/slam_app/SlamConfig.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "lamp/core/Seeded.h"
#include "lamp/registration/LoopClosureComputation.h"

namespace lamp {

namespace fs = std::filesystem;

namespace {

const std::string kRobotPrefix = "robot.";
const std::string kBeaconPrefix = "beacon.";
const std::string kStagePrefix = "lamp::";

const char* const kParametersIntroduction = R"(# Parameters

Every section and key of an experiment file, with its default. This page is what `lamp-slam --dump-parameters` prints.

- A stage is named in `[pipeline]` as `Class` or, for several instances, `Class@name`; its options are in `[lamp::Class]` or
  `[lamp::Class@name]`.
- `--set section.key=value` overrides one key; `--dump-config` prints what would be run.
- `//` after white space starts a comment; `@define NAME VALUE`, `${NAME}` and `$env{NAME}` work as in MRPT.
- Unknown sections and keys, malformed numbers and duplicates are errors; all are listed at once, with file and line.

## Sections

)";

/** `file:line` of a key of `[pipeline]`, or the section where the default is used. */
std::string wherePipeline(const Ini& ini, const std::string& key) {
  const Ini::Section* section = ini.find("pipeline");
  const Ini::Entry* entry = section ? section->find(key) : nullptr;
  return (entry ? entry->where + ": " : "") + "[pipeline] " + key;
}

/** Stages that had another name up to version 0.1 are still found under it. */
std::string currentName(const std::string& name) {
  static const std::map<std::string, std::string> renamed = {
      {"Identity", "IdentityGuess"},
      {"Odometry", "OdometryGuess"},
      {"OdometryRotation", "OdometryRotationGuess"}};
  const auto found = renamed.find(name);
  return found == renamed.end() ? name : found->second;
}

/** \param ini with the stages' sections. \param seed of stages that are Seeded. \param faults gets
 * names that are unknown, or missing, and wrong options. */
std::vector<std::shared_ptr<Stage>> makeStages(const StageKind& kind,
                                               const std::vector<std::string>& names,
                                               const Ini& ini, uint32_t seed, Faults& faults) {
  const std::string where = wherePipeline(ini, kind.key);
  if (names.empty() && kind.count != StageCount::kAny) faults.add(where, "needs a name");
  if (names.size() > 1 && kind.count == StageCount::kExactlyOne)
    faults.add(where, "takes one name, not " + std::to_string(names.size()));
  std::vector<std::shared_ptr<Stage>> stages;
  for (const std::string& name : names) {
    stages.push_back(makeStage(StageName::parse(name), kind.base, kind.name, where, ini, faults));
    if (auto* const random = dynamic_cast<Seeded*>(stages.back().get())) random->setSeed(seed);
  }
  return stages;
}

/** A path as seen from anywhere; an empty one stays empty. */
std::string anchored(const std::string& path, const fs::path& folder) {
  return path.empty() ? path : (folder / path).lexically_normal().string();
}

/** Makes the paths of recordings in an ini absolute. */
void anchorPaths(Ini& ini, const fs::path& folder) {
  std::vector<std::pair<std::string, Ini::Entry>> changed;
  for (const Ini::Section& section : ini.sections())
    for (Ini::Entry entry : section.entries) {
      const bool of_robot =
          section.name.rfind(kRobotPrefix, 0) == 0 &&
          (entry.key == "rawlog" || entry.key == "odometry_file" || entry.key == "arrivals");
      if (!of_robot && !(section.name == "input" && entry.key == "rawlogs")) continue;
      std::string list;
      for (const std::string& path : splitWords(entry.value))
        list += (list.empty() ? "" : ", ") + anchored(path, folder);
      entry.value = of_robot ? anchored(entry.value, folder) : list;
      changed.emplace_back(section.name, entry);
    }
  for (const auto& [section, entry] : changed)
    ini.set(section, entry.key, entry.value, entry.where);
}

}  // namespace

void PluginOptions::visit(OptionVisitor& v) {
  v("load", load, "plugin libraries that add further stages");
}

void InputOptions::visit(OptionVisitor& v) {
  v("rawlogs", rawlogs, "recordings, in addition to those named in [robot.NAME] sections");
  v("order", order,
    "order in which key nodes reach the base station: as recorded, or as listed in the robots' "
    "arrivals files",
    {"recorded", "arrival"});
}

void RunOptions::visit(OptionVisitor& v) {
  v("seed", seed, "", "seed of every random choice", kNotNegative);
  v("maps_every_key_nodes", maps_every_key_nodes, "",
    "writes the maps of the largest component each time that so many key nodes have come, for "
    "planners and viewers; 0 writes maps at the end only",
    kNotNegative);
}

void BaseStationOptions::visit(OptionVisitor& v) {
  v("closures_per_round", closures_per_round, "",
    "loop closures computed after each key node; 0 computes all waiting candidates", kNotNegative);
  v("optimize_min_loops", optimize_min_loops, "loops",
    "minimum number of new loop closures that triggers an optimisation", {1});
  v("optimize_growth", optimize_growth, "",
    "an optimisation also waits until the number of loop closures has grown by this fraction; "
    "larger values save time on long runs",
    kNotNegative);
  v("repropose_distance_m", repropose_distance_m, "m",
    "key nodes that optimisation has moved this far are searched for candidates again", kPositive);
  v("retry_distance_m", retry_distance_m, "m",
    "a refused candidate is tried again once its guess has moved this far", kPositive);
  v("max_attempts", max_attempts, "", "maximum number of attempts per pair of key nodes", {1});
}

SlamConfig SlamConfig::fromFile(const std::string& path, const std::vector<std::string>& overrides,
                                const std::vector<std::string>& rawlogs) {
  Faults faults;
  Ini ini;
  if (!path.empty()) {
    ini = Ini::fromFile(path, faults);
    anchorPaths(ini, fs::absolute(path).parent_path());
  }
  for (const std::string& assignment : overrides) ini.set(assignment, faults);
  SlamConfig config(std::move(ini), std::move(faults));
  config.input.rawlogs.insert(config.input.rawlogs.end(), rawlogs.begin(), rawlogs.end());
  for (std::string& rawlog : config.input.rawlogs) rawlog = anchored(rawlog, fs::current_path());
  for (RobotOptions& robot : config.robots)
    for (std::string* file : {&robot.rawlog, &robot.odometry_file, &robot.arrivals})
      *file = anchored(*file, fs::current_path());
  return config;
}

SlamConfig::SlamConfig(Ini ini, Faults faults) : ini_(std::move(ini)) {
  readOptions(ini_.find("plugins"), plugins, faults);
  loadPlugins(plugins.load);
  readOptions(ini_.find("run"), run, faults);
  readOptions(ini_.find("input"), input, faults);
  readOptions(ini_.find("pipeline"), pipeline, faults);
  for (std::string& name : pipeline.initial_aligner) name = currentName(name);
  readOptions(ini_.find("frontend"), frontend, faults);
  readOptions(ini_.find("gate"), gate, faults);
  readOptions(ini_.find("registration"), registration, faults);
  readOptions(ini_.find("base_station"), base_station, faults);
  readOptions(ini_.find("refinement"), refinement, faults);
  readOptions(ini_.find("occupancy"), occupancy, faults);
  readRobots(faults);
  readBeacons(faults);
  checkGate(faults);
  checkArrivals(faults);
  checkStages(faults);
  checkSections(faults);
  faults.throwIfAny();
}

void SlamConfig::readRobots(Faults& faults) {
  RobotTable names;
  for (const Ini::Section& section : ini_.sections()) {
    if (section.name.rfind(kRobotPrefix, 0) != 0) continue;
    RobotOptions robot;
    robot.name = section.name.substr(kRobotPrefix.size());
    readOptions(&section, robot, faults);
    if (robot.key.size() > 1)
      faults.add(section.find("key")->where,
                 "[" + section.name + "] key = " + robot.key + ": must be one letter");
    try {
      names.add(robot.name, robot.key.empty() ? '\0' : robot.key.front());
    } catch (const std::runtime_error& error) {
      faults.add(section.where, error.what());
    }
    robots.push_back(std::move(robot));
  }
}

/** Each number belongs to one beacon, or robot. */
void SlamConfig::readBeacons(Faults& faults) {
  std::set<int> taken;
  for (const RobotOptions& robot : robots)
    if (robot.beacon_id >= 0 && !taken.insert(robot.beacon_id).second)
      faults.add(ini_.find(kRobotPrefix + robot.name)->find("beacon_id")->where,
                 "[robot." + robot.name + "] beacon_id: another robot has the same");
  for (const Ini::Section& section : ini_.sections()) {
    if (section.name.rfind(kBeaconPrefix, 0) != 0) continue;
    BeaconOptions beacon;
    beacon.name = section.name.substr(kBeaconPrefix.size());
    readOptions(&section, beacon, faults);
    if (beacon.id < 0)
      faults.add(section.where, "[" + section.name + "] id: is missing");
    else if (!taken.insert(beacon.id).second)
      faults.add(section.find("id")->where,
                 "[" + section.name + "] id: another beacon, or robot, has the same");
    beacons.push_back(std::move(beacon));
  }
}

void SlamConfig::checkGate(Faults& faults) const {
  for (const RobotOptions& robot : robots) {
    if (!robot.startsAtGate()) continue;
    if (const auto fault = faultOf(gate))
      faults.add(ini_.find(kRobotPrefix + robot.name)->find("calibration")->where,
                 "[robot." + robot.name + "] calibration = gate: [gate] plates " + *fault);
  }
}

/** In the order of arrival, a robot of which nobody knows when it arrives has no place. */
void SlamConfig::checkArrivals(Faults& faults) const {
  if (!input.inArrivalOrder()) return;
  if (robots.empty())
    faults.add(ini_.find("input")->find("order")->where,
               "[input] order = arrival: needs a section [robot.NAME] with arrivals = FILE.csv for "
               "each robot");
  for (const RobotOptions& robot : robots)
    if (robot.arrivals.empty())
      faults.add(ini_.find(kRobotPrefix + robot.name)->where,
                 "[robot." + robot.name +
                     "] arrivals: is missing; [input] order = arrival needs it for each robot");
}

void SlamConfig::checkStages(Faults& faults) const {
  for (const StageKind& kind : stageKinds())
    makeStages(kind, pipeline.*kind.names, ini_, static_cast<uint32_t>(run.seed), faults);
}

std::vector<std::shared_ptr<Stage>> SlamConfig::make(const StageKind& kind) const {
  Faults faults;
  auto stages =
      makeStages(kind, pipeline.*kind.names, ini_, static_cast<uint32_t>(run.seed), faults);
  faults.throwIfAny();
  return stages;
}

/** Sections that nothing reads are faults; options of stages that take no part are checked too. */
void SlamConfig::checkSections(Faults& faults) const {
  static const std::vector<std::string> kSections = {
      "plugins", "run",          "input",        "pipeline",   "frontend",
      "gate",    "registration", "base_station", "refinement", "occupancy"};
  for (const Ini::Section& section : ini_.sections()) {
    const std::string& name = section.name;
    const bool known = name.rfind(kRobotPrefix, 0) == 0 || name.rfind(kBeaconPrefix, 0) == 0 ||
                       std::find(kSections.begin(), kSections.end(), name) != kSections.end();
    if (known) continue;
    if (name.rfind(kStagePrefix, 0) != 0) {
      faults.add(section.where, "there is no section [" + name + "]" + didYouMean(name, kSections));
      continue;
    }
    const StageName stage = StageName::parse(name.substr(kStagePrefix.size()));
    std::vector<std::string> used;
    for (const StageKind& kind : stageKinds())
      used.insert(used.end(), (pipeline.*kind.names).begin(), (pipeline.*kind.names).end());
    if (std::find(used.begin(), used.end(), stage.text()) == used.end())
      makeStage(stage, CLASS_ID(Stage), "stage", section.where, ini_, faults);
  }
}

LoopClosureComputation SlamConfig::makeLoopClosureComputation() const {
  const auto aligners = make<InitialAligner>();
  const auto verifiers = make<Verifier>();
  return {{aligners.begin(), aligners.end()},
          makeOne<Refiner>(),
          {verifiers.begin(), verifiers.end()},
          registration.ambiguity};
}

BaseStationSetup SlamConfig::makeBaseStationSetup() const {
  return {base_station,
          pipeline.inter_robot_loops,
          make<CandidateGenerator>(),
          makeOne<Prioritizer>(),
          registration.preparation,
          makeLoopClosureComputation(),
          {make<OutlierRejection>(), makeOne<Optimizer>()},
          refinement,
          {robots, beacons}};
}

MapExporters SlamConfig::makeMapExporters() const {
  return {make<MapExporter>(), std::make_shared<Occupancy>(occupancy)};
}

std::string SlamConfig::text() const {
  SlamConfig copy = *this;  // visit() takes options that it may change
  std::string text =
      writeOptions("plugins", copy.plugins) + "\n" + writeOptions("run", copy.run) + "\n" +
      writeOptions("input", copy.input) + "\n" + writeOptions("pipeline", copy.pipeline) + "\n" +
      writeOptions("frontend", copy.frontend) + "\n" + writeOptions("gate", copy.gate) + "\n" +
      writeOptions("registration", copy.registration) + "\n" +
      writeOptions("base_station", copy.base_station) + "\n" +
      writeOptions("refinement", copy.refinement) + "\n" +
      writeOptions("occupancy", copy.occupancy);
  for (RobotOptions& robot : copy.robots)
    text += "\n" + writeOptions(kRobotPrefix + robot.name, robot);
  for (BeaconOptions& beacon : copy.beacons)
    text += "\n" + writeOptions(kBeaconPrefix + beacon.name, beacon);

  std::set<std::string> written;
  for (const StageKind& kind : stageKinds())
    for (const auto& stage : make(kind)) {
      const std::string section = StageName::parse(stage->getLoggerName()).section();
      if (written.insert(section).second) text += "\n" + writeOptions(section, *stage);
    }
  return text;
}

std::string describeParameters() {
  const auto table = [](const std::string& section, auto&& options) {
    MarkdownOptionWriter writer(section);
    options.visit(writer);
    return writer.text() + "\n";
  };
  std::string text = kParametersIntroduction;
  text += table("plugins", PluginOptions{}) + table("run", RunOptions{}) +
          table("input", InputOptions{}) + table("pipeline", PipelineOptions{}) +
          table("frontend", FrontEndOptions{}) + table("gate", GateOptions{}) +
          table("registration", RegistrationOptions{}) +
          table("base_station", BaseStationOptions{}) + table("refinement", RefinementOptions{}) +
          table("occupancy", OccupancyOptions{}) + table("robot.NAME", RobotOptions{}) +
          table("beacon.NAME", BeaconOptions{});
  for (const StageKind& kind : stageKinds()) {
    text += "## [pipeline] " + std::string(kind.key) + "\n\n";
    for (const std::string& name : stageClasses(kind.base)) {
      Faults faults;
      const auto stage = makeStage(StageName{name, ""}, kind.base, kind.name, "", Ini{}, faults);
      text += table(kStagePrefix + name, *stage);
    }
  }
  return text;
}

}  // namespace lamp
