#include "lamp/slam_app/StageKinds.h"

#include <stdexcept>

#include "lamp/frontend/OdometrySource.h"
#include "lamp/loop_candidates/CandidateGenerator.h"
#include "lamp/loop_priority/Prioritizer.h"
#include "lamp/maps/MapExporter.h"
#include "lamp/pose_graph/Optimizer.h"
#include "lamp/pose_graph/OutlierRejection.h"
#include "lamp/registration/InitialAligner.h"
#include "lamp/registration/LoopClosureComputation.h"
#include "lamp/registration/Refiner.h"
#include "lamp/registration/Verifier.h"

namespace lamp {

const std::vector<StageKind>& stageKinds() {
  using P = PipelineOptions;
  using C = StageCount;
  static const std::vector<StageKind> kinds = {
      {"odometry", "odometry source",
       "odometry sources in order of preference; LidarOdometry uses the others as a prior",
       CLASS_ID(OdometrySource), &P::odometry, C::kAtLeastOne},
      {"candidates", "candidate generator",
       "candidate generators; with none, the map follows odometry alone",
       CLASS_ID(CandidateGenerator), &P::candidates, C::kAny},
      {"priority", "prioritizer", "decides the order in which candidates are computed",
       CLASS_ID(Prioritizer), &P::priority, C::kExactlyOne},
      {"initial_aligner", "initial aligner",
       "first stage of the loop closure computation; each is tried only if the ones before it "
       "found no loop closure",
       CLASS_ID(InitialAligner), &P::initial_aligner, C::kAtLeastOne},
      {"refiner", "refiner", "second stage of the loop closure computation", CLASS_ID(Refiner),
       &P::refiner, C::kExactlyOne},
      {"verifiers", "verifier", "all of these must accept a loop closure", CLASS_ID(Verifier),
       &P::verifiers, C::kAny},
      {"outlier_rejection", "outlier rejection",
       "stages that reject loop closures before the optimizer runs, applied in this order",
       CLASS_ID(OutlierRejection), &P::outlier_rejection, C::kAny},
      {"optimizer", "optimizer", "back end", CLASS_ID(Optimizer), &P::optimizer, C::kExactlyOne},
      {"exporters", "map exporter", "map formats to write", CLASS_ID(MapExporter), &P::exporters,
       C::kAny}};
  return kinds;
}

const StageKind& stageKind(const mrpt::rtti::TRuntimeClassId* base) {
  for (const StageKind& kind : stageKinds())
    if (kind.base == base) return kind;
  throw std::logic_error(std::string("no kind of stage has the base ") + base->className);
}

void PipelineOptions::visit(OptionVisitor& v) {
  for (const StageKind& kind : stageKinds()) v(kind.key, this->*kind.names, kind.meaning);
  v("inter_robot_loops", inter_robot_loops, "search for loop closures between robots");
}

void registerAllClasses_lamp() {
  registerAllClasses_lamp_core();
  registerAllClasses_lamp_frontend();
  registerAllClasses_lamp_loop_candidates();
  registerAllClasses_lamp_loop_priority();
  registerAllClasses_lamp_registration();
  registerAllClasses_lamp_pose_graph();
  registerAllClasses_lamp_maps();
}

std::string listStages() {
  std::string text;
  for (const StageKind& kind : stageKinds()) {
    text += std::string(kind.name) + "s ([pipeline] " + kind.key + "):\n";
    for (const std::string& name : stageClasses(kind.base)) text += "  " + name + "\n";
  }
  return text;
}

}  // namespace lamp
