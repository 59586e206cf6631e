#pragma once

#include <vector>

#include "lamp/core/PoseGraph.h"
#include "lamp/core/Stage.h"

namespace lamp {

/** Decides before the optimisation which loop closures may take part in it (paper II-D). */
class OutlierRejection : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(OutlierRejection)

 public:
  /** \param admitted one flag for each edge; those of loops that must stay out are cleared. Loops
   *  that are out already are not looked at. */
  virtual void reject(const PoseGraph& graph, std::vector<bool>& admitted) = 0;
};

}  // namespace lamp
