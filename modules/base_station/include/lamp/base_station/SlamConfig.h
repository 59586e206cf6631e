#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/base_station/BaseStationOptions.h"
#include "lamp/core/Ini.h"
#include "lamp/frontend/FrontEnd.h"
#include "lamp/input/RobotOptions.h"
#include "lamp/loop_candidates/CandidateGenerator.h"
#include "lamp/loop_priority/Prioritizer.h"
#include "lamp/maps/MapExporter.h"
#include "lamp/pose_graph/BackEnd.h"
#include "lamp/registration/InitialAligner.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/registration/PreparedScanStore.h"
#include "lamp/registration/Refiner.h"
#include "lamp/registration/Verifier.h"

namespace lamp {

/** Section `[pipeline]`: which stages take part, by name. */
struct PipelineOptions {
  std::string odometry = "RecordedOdometry";
  std::vector<std::string> candidates = {"AdaptiveRadius", "GlobalSearch"};
  std::string priority = "Arrival";
  std::vector<std::string> initial_aligner{"Odometry", "Teaser"};
  std::string refiner = "Gicp";
  std::vector<std::string> verifiers = {"GuessDeviation", "OverlapResidual", "FreeSpaceConsistency",
                                        "BothDirections"};
  std::vector<std::string> outlier_rejection = {"OdometryGate", "ChanceAgreement",
                                                "RobotFrames"};
  std::string optimizer = "Gnc";
  std::vector<std::string> exporters = {"Ply", "Pcd", "OctoMap", "Picture"};
  bool inter_robot_loops = true;

  void visit(OptionVisitor& v);
};

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

  void visit(OptionVisitor& v);
};

/** The stages of `[pipeline]`, made and configured. */
struct Stages {
  std::vector<std::shared_ptr<CandidateGenerator>> candidates;
  std::shared_ptr<Prioritizer> priority;
  std::vector<std::shared_ptr<InitialAligner>> initial_aligners;
  std::shared_ptr<Refiner> refiner;
  std::vector<std::shared_ptr<Verifier>> verifiers;
  BackEnd back_end;
  std::vector<std::shared_ptr<MapExporter>> exporters;
};

/** An experiment: everything that an ini file and the command line say. */
class SlamConfig {
 public:
  /** Loads plugins, makes the stages and reads all options.
   *  \param faults that reading the ini has found.
   *  \throws ConfigError with all faults at once; std::runtime_error if a file cannot be read. */
  explicit SlamConfig(Ini ini, Faults faults = {});
  /** Reads the file and applies `section.key=value` overrides. Paths of recordings in the file are
   * relative to the file, those of overrides and `rawlogs` to the working directory; all become
   * absolute. \param rawlogs further recordings, beside those that the ini names. */
  static SlamConfig fromFile(const std::string& path, const std::vector<std::string>& overrides,
                             const std::vector<std::string>& rawlogs = {});

  PluginOptions plugins;
  RunOptions run;
  InputOptions input;
  PipelineOptions pipeline;
  FrontEndOptions frontend;
  RegistrationOptions registration;
  BaseStationOptions base_station;
  std::vector<RobotOptions> robots;    ///< in the order of the ini
  std::vector<BeaconOptions> beacons;  ///< in the order of the ini
  Stages stages;

  /** A new odometry source, one for each robot. */
  std::shared_ptr<OdometrySource> makeOdometry() const;

  LoopClosureComputation makeLoopClosureComputation() const;

  /** The effective ini: complete, and running it again gives the same run. */
  std::string text() const;

  /** The ini as it was read: for making further stages of its sections. */
  const Ini& ini() const { return ini_; }

 private:
  void readRobots(Faults& faults);
  void readBeacons(Faults& faults);
  void checkArrivals(Faults& faults) const;
  void makeStages(Faults& faults);
  void checkSections(Faults& faults) const;

  Ini ini_;
};

/** Registers the stages of all modules; to be called before anything is made by name. */
void registerAllClasses_lamp();

/** All stage classes by kind, one line a class; what `--list-modules` prints. */
std::string listStages();

/** Every section with all its keys, defaults, units and meanings as Markdown. */
std::string describeParameters();

}  // namespace lamp
