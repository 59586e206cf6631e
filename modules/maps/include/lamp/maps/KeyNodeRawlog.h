#pragma once

#include <string>
#include <vector>

#include "lamp/core/KeyNodePacket.h"

namespace lamp {

/** Writes the key nodes of one robot as a gz-compressed MRPT rawlog of stock classes, in stamp
 * order; the same packets give the same bytes.
 *
 * Each key node becomes a CObservationRobotPose `<robot>/odometry` with `odom_T_base`, and for each
 * sensor of its scan a CObservationPointCloud `<robot>/<sensor label>` (`lidar` where the label is
 * empty). Its points stand in a frame at the sensor's origin with the axes of the base, so that
 * readers who know nothing of key nodes carve free space along the true rays. The covariance of the
 * odometry pose is zero, that is not given: drift belongs to the odometry edges, and packets carry
 * no covariance of the accumulated pose.
 *
 * \throws std::runtime_error naming the path, or the key node whose stamp, pose or scan is invalid.
 */
void writeKeyNodeRawlog(const std::string& path, const std::string& robot,
                        const std::vector<KeyNodePacket>& packets);

}  // namespace lamp
