#pragma once

#include <optional>

#include "lamp/core/Geometry.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** Along an axis that the matched surfaces leave free, two scans may still say that they are in the
 * wrong place: surfaces across the axis, as the wall at a tunnel's end, that each of them sees
 * where the other one sees through. How far the source must slide along the axis so that those lie
 * on one another. \param axis unit vector in the target's frame. \return metres; none if nothing
 * contradicts the pose, or no single slide brings the surfaces together. */
std::optional<double> slideOntoSurfacesAcross(const PreparedScan& source,
                                              const PreparedScan& target,
                                              const Pose3& target_T_source,
                                              const Eigen::Vector3d& axis);

}  // namespace lamp
