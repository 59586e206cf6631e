#include "lamp/loop_priority/Prioritizer.h"

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Prioritizer, Stage, lamp)
IMPLEMENTS_MRPT_OBJECT(Arrival, lamp::Prioritizer, lamp)

namespace lamp {

void Arrival::order(std::vector<LoopClosureCandidate>& candidates, const PoseGraph&,
                    const UncertaintyQuery&) {
  for (LoopClosureCandidate& candidate : candidates) candidate.priority = 0;
}

void registerAllClasses_lamp_loop_priority() {
  mrpt::rtti::registerClass(CLASS_ID(Prioritizer));
  mrpt::rtti::registerClass(CLASS_ID(Arrival));
}

}  // namespace lamp
