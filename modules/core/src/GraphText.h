#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lamp/core/PoseGraph.h"

namespace lamp {

/** How one kind of text file writes poses and information matrices. */
struct TextFormat {
  const char* vertex;
  const char* edge;
  std::vector<double> (*pose)(const Pose3&);
  Eigen::MatrixXd (*information)(const Edge&);
};
/** VERTEX_SE2 and EDGE_SE2; VERTEX_SE3:QUAT and EDGE_SE3:QUAT. */
extern const TextFormat kPlanarText, kQuaternionText;

/** Ids from 0 in node order. */
std::vector<uint64_t> denseIds(const PoseGraph& graph);

/** Each with a space before it, in 17 digits. */
std::string joined(const std::vector<double>& values);
/** Row by row. */
std::vector<double> upperTriangle(const Eigen::MatrixXd& m);

std::string nodeLines(const PoseGraph& graph, const TextFormat& format,
                      const std::vector<uint64_t>& ids);
/** Odometry and loop closures that are not rejected. */
std::string edgeLines(const PoseGraph& graph, const TextFormat& format,
                      const std::vector<uint64_t>& ids);

}  // namespace lamp
