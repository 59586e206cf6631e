#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/scans/Cloud.h"

namespace lamp {

/** Whether each point's normal is that of a surface, 1 or 0: the rays around the point's own ray,
 * on most sides of it, met that surface, too. A normal can also come from the pattern of the scan:
 * fitted to the outline of a corridor that one ring of a lidar draws far away, it looks along the
 * corridor; but the rays beside the ring went on.
 * \param normals of the cloud's points; zero if unknown, and then without support.
 * \param noise_m how far points lie off their surface, standard deviation.
 * \param planar the points of a level 2D laser: a ray has neighbours to its left and right only. */
std::vector<uint8_t> surfaceSupport(const Cloud& cloud, const std::vector<Eigen::Vector3f>& normals,
                                    double noise_m, bool planar);

}  // namespace lamp
