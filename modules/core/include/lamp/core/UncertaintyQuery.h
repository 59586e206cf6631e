#pragma once

#include <optional>
#include <vector>

#include "lamp/core/Geometry.h"
#include "lamp/core/Ids.h"

namespace lamp {

/** How well the graph knows one key node relative to another. Implemented by `pose_graph`. */
class UncertaintyQuery {
 public:
  virtual ~UncertaintyQuery() = default;

  /** Covariance of `from_T_to[k]` in its tangent space, for each k; none where the graph has no
   * path from `from`, over edges or over start priors. */
  virtual std::vector<std::optional<Matrix6d>> relativeCovariances(
      KeyNodeId from, const std::vector<KeyNodeId>& to) const = 0;
};

}  // namespace lamp
