#include "G2oEdges.h"

#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"
#include "lamp/core/Files.h"
#include "lamp/core/GraphFiles.h"

namespace lamp::evaluation {

namespace {

constexpr size_t kPlanarNumbers = 3 + 6, kSpatialNumbers = 7 + 21;

/** A symmetric matrix from the rows of its upper triangle. */
Eigen::MatrixXd fromUpperTriangle(const double* values, Eigen::Index size) {
  Eigen::MatrixXd m(size, size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = i; j < size; ++j) m(i, j) = m(j, i) = *values++;
  return m;
}

G2oEdge planarEdge(const std::vector<double>& v) {
  constexpr double kCertain = 1e12;
  G2oEdge edge{planarPose(v[0], v[1], v[2]), kCertain * Matrix6d::Identity()};
  const Eigen::MatrixXd information = fromUpperTriangle(v.data() + 3, 3);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      edge.information(kPlanarAxes[i], kPlanarAxes[j]) = information(i, j);
  return edge;
}

G2oEdge spatialEdge(const std::vector<double>& v) {
  G2oEdge edge;
  edge.from_T_to.translation() << v[0], v[1], v[2];
  edge.from_T_to.linear() =
      Eigen::Quaterniond(v[6], v[3], v[4], v[5]).normalized().toRotationMatrix();
  edge.information = fromG2oInformation(fromUpperTriangle(v.data() + 7, 6));
  return edge;
}

}  // namespace

G2oEdges readG2oEdges(const std::string& path) {
  G2oEdges edges;
  std::istringstream in(readTextFile(path));
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string kind, word;
    words >> kind;
    const bool planar = kind == "EDGE_SE2";
    if (!planar && kind != "EDGE_SE3:QUAT") continue;
    uint32_t from = 0, to = 0;
    bool good = static_cast<bool>(words >> from >> to);
    std::vector<double> values;
    while (good && words >> word) good = parseDouble(word, values.emplace_back());
    if (!good || values.size() != (planar ? kPlanarNumbers : kSpatialNumbers))
      throw std::runtime_error(path + ":" + std::to_string(number) + ": is no " + kind);
    edges[{from, to}].push_back(planar ? planarEdge(values) : spatialEdge(values));
  }
  return edges;
}

}  // namespace lamp::evaluation
