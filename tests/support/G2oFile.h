#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp::test {

/** A pose graph as g2o's documentation describes its text format; a reader of its own, to check the
 * writer against. */
struct G2oFile {
  struct Edge {
    int from = 0, to = 0;
    Pose3 from_T_to = Pose3::Identity();
    Matrix6d information = Matrix6d::Zero();  ///< g2o's: x y z, vector part of the quaternion
  };

  std::map<int, Pose3> vertices;
  std::vector<Edge> edges;
  std::set<int> fixed;

  /** Reads a graph of VERTEX_SE3:QUAT, EDGE_SE3:QUAT and FIX.
   *  \throws std::runtime_error if there is any other line, or too few numbers in one. */
  static G2oFile read(const std::string& path);
};

}  // namespace lamp::test
