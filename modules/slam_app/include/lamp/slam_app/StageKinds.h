#pragma once

#include <string>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Stage.h"

namespace lamp {

/** Section `[pipeline]`: which stages take part, by name. */
struct PipelineOptions {
  std::vector<std::string> odometry{"LidarOdometry", "RecordedOdometry"};
  std::vector<std::string> candidates{"AdaptiveRadius", "PlaceRecognition", "Neighbors"};
  std::vector<std::string> priority{"Arrival"};
  std::vector<std::string> initial_aligner{"OdometryGuess", "Teaser", "PlanarSearch"};
  std::vector<std::string> refiner{"Gicp"};
  std::vector<std::string> verifiers{"GuessDeviation", "OverlapResidual", "FreeSpaceConsistency",
                                     "BothDirections"};
  std::vector<std::string> outlier_rejection{"OdometryGate", "ChanceAgreement", "RobotFrames"};
  std::vector<std::string> optimizer{"Gnc"};
  std::vector<std::string> exporters{
      "Ply", "Pcd", "OctoMap", "OccupancyGrid", "Traversability", "Picture", "Scene3d"};
  bool inter_robot_loops = true;

  void visit(OptionVisitor& v);
};

enum class StageCount { kExactlyOne, kAtLeastOne, kAny };

/** A kind of stage that `[pipeline]` names. The table of them, in StageKinds.cpp, is the one place
 * that a new kind is added to. */
struct StageKind {
  const char* key;   ///< of `[pipeline]`
  const char* name;  ///< of one of them, in messages
  const char* meaning;
  const mrpt::rtti::TRuntimeClassId* base;
  std::vector<std::string> PipelineOptions::*names;
  StageCount count;
};

/** All kinds, in the order of the data flow. */
const std::vector<StageKind>& stageKinds();

/** \throws std::logic_error if the table has no kind with this base. */
const StageKind& stageKind(const mrpt::rtti::TRuntimeClassId* base);

/** Registers the stages of all modules; to be called before anything is made by name. */
void registerAllClasses_lamp();

/** All stage classes by kind, one per line; what `--list-modules` prints. */
std::string listStages();

}  // namespace lamp
