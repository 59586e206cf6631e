#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/base_station/BaseStation.h"
#include "lamp/base_station/BaseStationOptions.h"
#include "lamp/core/Ini.h"
#include "lamp/frontend/FrontEnd.h"
#include "lamp/frontend/GateCalibration.h"
#include "lamp/input/RobotOptions.h"
#include "lamp/maps/MapExporter.h"
#include "lamp/refinement/RefinementOptions.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/registration/PreparedScanStore.h"
#include "lamp/slam_app/StageKinds.h"

namespace lamp {

struct PluginOptions {
  std::vector<std::string> load;

  void visit(OptionVisitor& v);
};

struct InputOptions {
  std::vector<std::string> rawlogs;
  std::string order = "recorded";

  /** Whether key nodes come as the radio link delivers them, by the robots' arrivals files. */
  bool inArrivalOrder() const { return order == "arrival"; }

  void visit(OptionVisitor& v);
};

struct RegistrationOptions {
  PreparationOptions preparation;
  AmbiguityOptions ambiguity;

  void visit(OptionVisitor& v) {
    preparation.visit(v);
    ambiguity.visit(v);
  }
};

struct RunOptions {
  int seed = 1;
  int maps_every_key_nodes = 0;

  void visit(OptionVisitor& v);
};

/** The exporters of a run, and the occupancy that they share. */
struct MapExporters {
  std::vector<std::shared_ptr<MapExporter>> stages;
  std::shared_ptr<Occupancy> occupancy;
};

/** An experiment: everything that an ini file and the command line say. */
class SlamConfig {
 public:
  /** Loads plugins, reads all options and makes each stage once, to check it.
   *  \param faults that reading the ini has found.
   *  \throws ConfigError with all faults at once; std::runtime_error if a file cannot be read. */
  explicit SlamConfig(Ini ini, Faults faults = {});
  /** Reads the file and applies `section.key=value` overrides. Paths of recordings in the file are
   * relative to the file, those of overrides and `rawlogs` to the working directory; all become
   * absolute. \param path empty for the defaults.
   * \param rawlogs recordings in addition to those that the ini names. */
  static SlamConfig fromFile(const std::string& path, const std::vector<std::string>& overrides,
                             const std::vector<std::string>& rawlogs = {});

  PluginOptions plugins;
  RunOptions run;
  InputOptions input;
  PipelineOptions pipeline;
  FrontEndOptions frontend;
  GateOptions gate;
  RegistrationOptions registration;
  BaseStationOptions base_station;
  RefinementOptions refinement;
  OccupancyOptions occupancy;
  std::vector<RobotOptions> robots;    ///< in the order of the ini
  std::vector<BeaconOptions> beacons;  ///< in the order of the ini

  /** The stages of one kind that `[pipeline]` names, made anew: stages may keep state, so whatever
   * runs on its own needs its own. */
  template <class Base>
  std::vector<std::shared_ptr<Base>> make() const {
    std::vector<std::shared_ptr<Base>> stages;
    for (const auto& stage : make(stageKind(CLASS_ID(Base))))
      stages.push_back(std::dynamic_pointer_cast<Base>(stage));
    return stages;
  }
  /** Of a kind of which a pipeline has exactly one. */
  template <class Base>
  std::shared_ptr<Base> makeOne() const {
    return make<Base>().front();
  }
  LoopClosureComputation makeLoopClosureComputation() const;
  BaseStationSetup makeBaseStationSetup() const;
  MapExporters makeMapExporters() const;

  /** The effective ini: complete, and running it again gives the same run. */
  std::string text() const;

  /** The ini as it was read: for making further stages of its sections. */
  const Ini& ini() const { return ini_; }

 private:
  void readRobots(Faults& faults);
  void readBeacons(Faults& faults);
  void checkGate(Faults& faults) const;
  void checkArrivals(Faults& faults) const;
  void checkStages(Faults& faults) const;
  void checkSections(Faults& faults) const;
  std::vector<std::shared_ptr<Stage>> make(const StageKind& kind) const;

  Ini ini_;
};

/** Every section with all its keys, defaults, units and meanings as Markdown. */
std::string describeParameters();

}  // namespace lamp
