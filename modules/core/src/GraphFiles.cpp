#include "lamp/core/GraphFiles.h"

#include <cmath>
#include <cstdio>
#include <vector>

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
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return buffer;
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

Eigen::Matrix3d planarBlock(const Matrix6d& m) {
  Eigen::Matrix3d result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result(i, j) = m(kPlanarAxes[i], kPlanarAxes[j]);
  return result;
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

/** Information on MRPT's `[x y z yaw pitch roll]`, which its files keep in that order. */
Matrix6d mrptInformation(const Edge& edge) {
  const Matrix6d J = tangentFromYawPitchRoll(edge.from_T_to);
  return J.transpose() * edge.information * J;
}

bool isWritten(const Edge& edge) {
  return edge.type != EdgeType::kPrior && edge.active();
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
  const bool planar = graph.planar();
  std::string text;
  for (size_t i = 0; i < graph.nodes().size(); ++i) {
    const Pose3& pose = graph.nodes()[i].world_T_base;
    text += (planar ? "VERTEX_SE2 " : "VERTEX_SE3:QUAT ") + std::to_string(i) +
            joined(planar ? planarValues(pose) : quaternionValues(pose)) + "\n";
  }
  for (const Component& component : graph.components())
    text += "FIX " + std::to_string(graph.place(component.nodes.front())) + "\n";
  for (const Edge& edge : graph.edges()) {
    if (!isWritten(edge)) continue;
    text += (planar ? "EDGE_SE2 " : "EDGE_SE3:QUAT ") + std::to_string(graph.place(edge.from)) +
            " " + std::to_string(graph.place(edge.to));
    if (planar)
      text += joined(planarValues(edge.from_T_to)) +
              joined(upperTriangle(planarBlock(edge.information)));
    else
      text += joined(quaternionValues(edge.from_T_to)) +
              joined(upperTriangle(toG2oInformation(edge.information)));
    text += "\n";
  }
  return text;
}

std::string toMrptGraph(const PoseGraph& graph) {
  const bool planar = graph.planar();
  std::string text;
  for (size_t i = 0; i < graph.nodes().size(); ++i) {
    const Pose3& pose = graph.nodes()[i].world_T_base;
    text += (planar ? "VERTEX2 " : "VERTEX3 ") + std::to_string(i) +
            joined(planar ? planarValues(pose) : rollPitchYawValues(pose)) + "\n";
  }
  for (const Edge& edge : graph.edges()) {
    if (!isWritten(edge)) continue;
    text += (planar ? "EDGE2 " : "EDGE3 ") + std::to_string(graph.place(edge.from)) + " " +
            std::to_string(graph.place(edge.to));
    if (planar) {
      // TORO's order of the six numbers: xx xy yy tt xt yt.
      const Eigen::Matrix3d m = planarBlock(edge.information);
      text += joined(planarValues(edge.from_T_to)) +
              joined({m(0, 0), m(0, 1), m(1, 1), m(2, 2), m(0, 2), m(1, 2)});
    } else {
      text +=
          joined(rollPitchYawValues(edge.from_T_to)) + joined(upperTriangle(mrptInformation(edge)));
    }
    text += "\n";
  }
  return text;
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
