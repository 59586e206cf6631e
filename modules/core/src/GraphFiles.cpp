#include "lamp/core/GraphFiles.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numeric>

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

std::string digits17(double value) {
  std::array<char, 32> buffer;
  const auto format = std::chars_format::general;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, 17).ptr;
  return {buffer.data(), end};
}

std::string joined(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += " " + digits17(value);
  return text;
}

std::vector<double> upperTriangle(const Eigen::MatrixXd& m) {
  std::vector<double> values;
  for (Eigen::Index i = 0; i < m.rows(); ++i)
    for (Eigen::Index j = i; j < m.cols(); ++j) values.push_back(m(i, j));
  return values;
}

Eigen::MatrixXd planarInformation(const Edge& edge) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = edge.information(kPlanarAxes[i], kPlanarAxes[j]);
  return result;
}

Eigen::MatrixXd quaternionInformation(const Edge& edge) {
  return toG2oInformation(edge.information);
}

std::vector<double> planarValues(const Pose3& T) {
  return {T.translation().x(), T.translation().y(), yawOf(T)};
}

std::vector<double> quaternionValues(const Pose3& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d t = T.translation();
  return {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
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

/** How one kind of text file writes poses and information matrices. */
struct TextFormat {
  const char* vertex;
  const char* edge;
  std::vector<double> (*pose)(const Pose3&);
  Eigen::MatrixXd (*information)(const Edge&);
};
constexpr TextFormat kPlanar{"VERTEX_SE2", "EDGE_SE2", planarValues, planarInformation};
constexpr TextFormat kQuaternion{"VERTEX_SE3:QUAT", "EDGE_SE3:QUAT", quaternionValues,
                                 quaternionInformation};
constexpr TextFormat kRollPitchYaw{"VERTEX3", "EDGE3", rollPitchYawValues, rollPitchYawInformation};

using Ids = std::vector<uint64_t>;

Ids denseIds(const PoseGraph& graph) {
  Ids ids(graph.nodes().size());
  std::iota(ids.begin(), ids.end(), uint64_t{0});
  return ids;
}

std::string nodeLines(const PoseGraph& graph, const TextFormat& format, const Ids& ids) {
  std::string text;
  for (size_t i = 0; i < graph.nodes().size(); ++i)
    text += std::string(format.vertex) + " " + std::to_string(ids[i]) +
            joined(format.pose(graph.nodes()[i].world_T_base)) + "\n";
  return text;
}

std::string edgeLines(const PoseGraph& graph, const TextFormat& format, const Ids& ids) {
  std::string text;
  for (const Edge& edge : graph.edges()) {
    if (!edge.joinsPoses() || !edge.active()) continue;
    text += std::string(format.edge) + " " + std::to_string(ids[graph.place(edge.from)]) + " " +
            std::to_string(ids[graph.place(edge.to)]) + joined(format.pose(edge.from_T_to)) +
            joined(upperTriangle(format.information(edge))) + "\n";
  }
  return text;
}

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

std::string toG2o(const PoseGraph& graph) {
  return toG2o(graph, denseIds(graph));
}

std::string toG2o(const PoseGraph& graph, const std::vector<uint64_t>& ids) {
  const TextFormat& format = graph.planar() ? kPlanar : kQuaternion;
  std::string fixed;
  for (const Component& component : graph.components())
    fixed += "FIX " + std::to_string(ids[graph.place(component.nodes.front())]) + "\n";
  return nodeLines(graph, format, ids) + fixed + edgeLines(graph, format, ids);
}

std::string toMrptGraph(const PoseGraph& graph) {
  const TextFormat& format = graph.planar() ? kPlanar : kRollPitchYaw;
  const Ids ids = denseIds(graph);
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
