#include "lamp/core/GraphFiles.h"

#include <cmath>

#include "GraphText.h"
#include "lamp/core/Csv.h"

namespace lamp {

namespace {

/** d(tangent) / d(x y z yaw pitch roll) at a pose: the tangent translation is in the body frame,
 * and the tangent rotation is the body's angular velocity under the Euler rates. */
Matrix6d tangentFromYawPitchRoll(const Pose3& pose) {
  const Vector6d v = yawPitchRollFromPose(pose);
  const double sp = std::sin(v[4]), cp = std::cos(v[4]), sr = std::sin(v[5]), cr = std::cos(v[5]);
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = pose.linear().transpose();
  J.bottomRightCorner<3, 3>() << -sp, 0, 1,  //
      sr * cp, cr, 0,                        //
      cr * cp, -sr, 0;
  return J;
}

/** `[x y z roll pitch yaw]`, the order of MRPT's 3D graph files. */
std::vector<double> rollPitchYawValues(const Pose3& T) {
  const Vector6d v = yawPitchRollFromPose(T);
  return {v[0], v[1], v[2], v[5], v[4], v[3]};
}

/** Information on `[x y z roll pitch yaw]`: the order of MRPT's files, not of its classes. */
Eigen::MatrixXd rollPitchYawInformation(const Edge& edge) {
  Matrix6d J = tangentFromYawPitchRoll(edge.from_T_to);
  J.col(3).swap(J.col(5));
  return J.transpose() * edge.information * J;
}

constexpr TextFormat kRollPitchYaw{"VERTEX3", "EDGE3", rollPitchYawValues, rollPitchYawInformation};

}  // namespace

Matrix6d toG2oInformation(const Matrix6d& information) {
  Vector6d scale;
  scale << 1, 1, 1, 2, 2, 2;
  return scale.asDiagonal() * information * scale.asDiagonal();
}

Matrix6d fromG2oInformation(const Matrix6d& information) {
  Vector6d scale;
  scale << 1, 1, 1, 0.5, 0.5, 0.5;
  return scale.asDiagonal() * information * scale.asDiagonal();
}

Matrix6d covarianceFromMrpt(const Pose3& pose, const Matrix6d& xyz_ypr) {
  const Matrix6d J = tangentFromYawPitchRoll(pose);
  return J * xyz_ypr * J.transpose();
}

Matrix6d covarianceToMrpt(const Pose3& pose, const Matrix6d& tangent) {
  const Matrix6d J = tangentFromYawPitchRoll(pose).inverse();
  return J * tangent * J.transpose();
}

std::string toMrptGraph(const PoseGraph& graph) {
  const TextFormat& format = graph.planar() ? kPlanarText : kRollPitchYaw;
  const std::vector<uint64_t> ids = denseIds(graph);
  return nodeLines(graph, format, ids) + edgeLines(graph, format, ids);
}

std::string toGraphIdsCsv(const PoseGraph& graph, const RobotTable& robots) {
  CsvTable table{{"id", "robot", "index", "symbol", "stamp"}, {}};
  for (size_t i = 0; i < graph.nodes().size(); ++i) {
    const Node& node = graph.nodes()[i];
    table.rows.push_back({std::to_string(i), robots.name(node.id.robot),
                          std::to_string(node.id.index), std::to_string(robots.symbol(node.id)),
                          formatFixed(node.stamp, 6)});
  }
  return table.text();
}

}  // namespace lamp
