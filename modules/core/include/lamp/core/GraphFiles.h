#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** Information in g2o's coordinates `[x y z, qx qy qz]`: its rotation error is the vector part of
 * the unit quaternion, half our rotation vector to first order. */
Matrix6d toG2oInformation(const Matrix6d& information);
Matrix6d fromG2oInformation(const Matrix6d& information);

/** Covariance of MRPT's `[x y z yaw pitch roll]` at a pose, from and to our tangent space. */
Matrix6d covarianceFromMrpt(const Pose3& pose, const Matrix6d& xyz_ypr);
Matrix6d covarianceToMrpt(const Pose3& pose, const Matrix6d& tangent);

/** The optimised graph as g2o text with 17 digits: SE2 if the graph is planar, else SE3:QUAT. Ids
 * are dense 32-bit numbers from 0 in node order. Only odometry and loop closures that are not
 * rejected are written; the first node of each component is fixed. */
std::string toG2o(const PoseGraph& graph);

/** The same graph in MRPT's text format: VERTEX3/EDGE3 with roll pitch yaw; a planar graph as
 * VERTEX_SE2/EDGE_SE2, since MRPT reads EDGE2 in g2o's order and not in TORO's. MRPT 2.5.8 itself
 * drops the correlations between the three angles when it reads EDGE3 (or g2o's EDGE_SE3:QUAT). */
std::string toMrptGraph(const PoseGraph& graph);

/** `id,robot,index,symbol,stamp` for the dense ids of the two formats above. */
std::string toGraphIdsCsv(const PoseGraph& graph, const RobotTable& robots);

}  // namespace lamp
