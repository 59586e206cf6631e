#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp::evaluation {

/** An edge of a g2o file. */
struct G2oEdge {
  Pose3 from_T_to = Pose3::Identity();
  Matrix6d information = Matrix6d::Zero();  ///< tangent space at from_T_to
};
using G2oEdges = std::map<std::pair<uint32_t, uint32_t>, std::vector<G2oEdge>>;

/** Edges by the ids of their ends. An edge of a planar graph fixes z, roll and pitch.
 * \throws std::runtime_error with file and line if the file is malformed. */
G2oEdges readG2oEdges(const std::string& path);

}  // namespace lamp::evaluation
