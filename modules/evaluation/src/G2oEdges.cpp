#include "G2oEdges.h"

#include "lamp/core/Files.h"
#include "lamp/core/G2oFile.h"

namespace lamp::evaluation {

namespace {

/** With full information on the motions that a planar robot cannot make. */
Matrix6d inSpace(const Matrix6d& planar) {
  constexpr double kCertain = 1e12;
  Matrix6d information = kCertain * Matrix6d::Identity();
  for (const int row : kPlanarAxes)
    for (const int column : kPlanarAxes) information(row, column) = planar(row, column);
  return information;
}

}  // namespace

G2oEdges readG2oEdges(const std::string& path) {
  const std::string text = readTextFile(path);
  if (text.empty()) return {};
  const G2oGraph g2o = g2oFromText(text, path);
  const auto id = [&](KeyNodeId node) {
    return static_cast<uint32_t>(g2o.ids[g2o.graph.place(node)]);
  };
  G2oEdges edges;
  for (const Edge& edge : g2o.graph.edges())
    if (edge.joinsPoses())
      edges[{id(edge.from), id(edge.to)}].push_back(
          {edge.from_T_to, g2o.graph.planar() ? inSpace(edge.information) : edge.information});
  return edges;
}

}  // namespace lamp::evaluation
