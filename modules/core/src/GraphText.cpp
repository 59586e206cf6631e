#include "GraphText.h"

#include <array>
#include <charconv>
#include <numeric>

#include "lamp/core/GraphFiles.h"

namespace lamp {

namespace {

std::string digits17(double value) {
  std::array<char, 32> buffer;
  const auto format = std::chars_format::general;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, 17).ptr;
  return {buffer.data(), end};
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

}  // namespace

const TextFormat kPlanarText{"VERTEX_SE2", "EDGE_SE2", planarValues, planarInformation};
const TextFormat kQuaternionText{"VERTEX_SE3:QUAT", "EDGE_SE3:QUAT", quaternionValues,
                                 quaternionInformation};

std::vector<uint64_t> denseIds(const PoseGraph& graph) {
  std::vector<uint64_t> ids(graph.nodes().size());
  std::iota(ids.begin(), ids.end(), uint64_t{0});
  return ids;
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

std::string nodeLines(const PoseGraph& graph, const TextFormat& format,
                      const std::vector<uint64_t>& ids) {
  std::string text;
  for (size_t i = 0; i < graph.nodes().size(); ++i)
    text += std::string(format.vertex) + " " + std::to_string(ids[i]) +
            joined(format.pose(graph.nodes()[i].world_T_base)) + "\n";
  return text;
}

std::string edgeLines(const PoseGraph& graph, const TextFormat& format,
                      const std::vector<uint64_t>& ids) {
  std::string text;
  for (const Edge& edge : graph.edges()) {
    if (!edge.joinsPoses() || !edge.active()) continue;
    text += std::string(format.edge) + " " + std::to_string(ids[graph.place(edge.from)]) + " " +
            std::to_string(ids[graph.place(edge.to)]) + joined(format.pose(edge.from_T_to)) +
            joined(upperTriangle(format.information(edge))) + "\n";
  }
  return text;
}

}  // namespace lamp
