#pragma once

#include <vector>

#include "lamp/refinement/Surfels.h"
#include "lamp/scans/MatchedSurface.h"

namespace lamp {

/** The surfels that each key node has seen, for finding those that two have seen both. */
class SharedSurfels {
 public:
  /** \param nodes how many key nodes the views may refer to. `surfels` must outlive the object. */
  SharedSurfels(const std::vector<Surfel>& surfels, size_t nodes);

  /** Of the surfels that the one has seen that has seen fewer, the share that the other has seen
   * too. */
  double share(size_t a, size_t b) const;

  /** A registration of two key nodes, one step of Gauss-Newton long. */
  struct Step {
    MatchedSurface surface;            ///< `pivot` and axes are those of key node `a`
    Vector6d step = Vector6d::Zero();  ///< right perturbation of `a_T_b`
  };
  /** The step that brings what both have seen of each surfel into its plane, with a Geman-McClure
   * kernel. \param world_T_node the poses at which the surfels were found. */
  Step registration(size_t a, size_t b, const std::vector<Pose3>& world_T_node) const;

 private:
  /** A view of the surfel with number `surfel`. */
  struct Seen {
    uint32_t surfel;
    const SurfelView* view;
  };

  const std::vector<Surfel>& surfels_;
  std::vector<std::vector<Seen>> seen_by_;  ///< each in the order of the surfels
};

}  // namespace lamp
