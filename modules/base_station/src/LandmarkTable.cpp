#include "lamp/base_station/LandmarkTable.h"

#include <cmath>
#include <set>

#include "lamp/pose_graph/MarginalCovariances.h"

namespace lamp {

namespace {

/** The edges of one landmark. */
struct Evidence {
  size_t edges = 0, inliers = 0;
  std::set<RobotId> robots;  ///< of the inliers
};

std::vector<Evidence> collect(const PoseGraph& graph) {
  std::vector<Evidence> evidence(graph.landmarks().size());
  for (const Edge& edge : graph.edges()) {
    if (!edge.endsAtLandmark()) continue;
    Evidence& of = evidence[edge.landmark];
    ++of.edges;
    if (edge.verdict != Verdict::kInlier) continue;
    ++of.inliers;
    of.robots.insert(edge.from.robot);
  }
  return evidence;
}

}  // namespace

CsvTable landmarkTable(const PoseGraph& graph, const RobotTable& robots) {
  CsvTable table{{"name", "x", "y", "z", "sigma_x", "sigma_y", "sigma_z", "known", "measurements",
                  "inliers", "robots"},
                 {}};
  const std::vector<Evidence> evidence = collect(graph);
  const MarginalCovariances marginals(graph);
  for (LandmarkIndex i = 0; i < graph.landmarks().size(); ++i) {
    const Landmark& landmark = graph.landmarks()[i];
    const Eigen::Vector3d variances = marginals.landmarkCovariance(i).diagonal();
    std::vector<std::string> row = {landmark.name};
    for (int axis = 0; axis < 3; ++axis)
      row.push_back(landmark.placed ? formatDouble(landmark.world_p[axis]) : "");
    for (int axis = 0; axis < 3; ++axis)
      row.push_back(landmark.placed ? formatDouble(std::sqrt(variances[axis])) : "");
    row.push_back(landmark.known ? "1" : "0");
    row.push_back(std::to_string(evidence[i].edges));
    row.push_back(std::to_string(evidence[i].inliers));
    std::string names;
    for (const RobotId robot : evidence[i].robots)
      names += (names.empty() ? "" : " ") + robots.name(robot);
    row.push_back(names);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace lamp
