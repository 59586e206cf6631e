#include "guess/LandmarkGuess.h"

#include <Eigen/SVD>
#include <utility>

#include "lamp/core/Median.h"
#include "solver/Information.h"

namespace lamp {

namespace {

struct Distance {
  Eigen::Vector3d world_p_antenna;
  double range_m;
};

/** What the edges say about one landmark. */
struct Evidence {
  std::vector<Eigen::Vector3d> sightings;  ///< in the world
  std::vector<Distance> distances;
};

std::vector<Evidence> collect(const PoseGraph& graph, const std::vector<Pose3>& world_T_base,
                              const std::vector<bool>& admitted) {
  const bool planar = graph.planar();
  std::vector<Evidence> evidence(graph.landmarks().size());
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e) {
    const Edge& edge = graph.edges()[e];
    if (!edge.endsAtLandmark() || !admitted[e]) continue;
    const Pose3& world_T_from = world_T_base[graph.place(edge.from)];
    if (edge.type == EdgeType::kRange)
      evidence[edge.landmark].distances.push_back(
          {world_T_from * edge.from_p_sensor, edge.from_T_to.translation().x()});
    else if (informationRank(edge.information, planar) == (planar ? 2 : 3))
      evidence[edge.landmark].sightings.push_back(world_T_from * edge.from_T_to.translation());
  }
  return evidence;
}

/** By coordinate, since up to half of the sightings may be mistaken. */
Eigen::Vector3d median(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d result;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : points) values.push_back(p[axis]);
    result[axis] = medianOf(std::move(values));
  }
  return result;
}

/** Where the spheres about the antennas meet: differences of `|p - a|² = r²` are linear in p. None
 * if the antennas lie too close to one plane (planar: one line) to tell its sides apart. */
std::optional<Eigen::Vector3d> multilaterate(const std::vector<Distance>& distances, int axes) {
  constexpr double kLeastSpread = 0.05;
  if (static_cast<int>(distances.size()) <= axes) return std::nullopt;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double mean = 0;
  const auto count = static_cast<double>(distances.size());
  for (const Distance& d : distances) centre += d.world_p_antenna / count;
  const auto term = [&](const Distance& d) {
    return (d.world_p_antenna - centre).squaredNorm() - d.range_m * d.range_m;
  };
  for (const Distance& d : distances) mean += term(d) / count;
  Eigen::MatrixXd A(distances.size(), axes);
  Eigen::VectorXd b(distances.size());
  for (size_t i = 0; i < distances.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    A.row(row) = 2.0 * (distances[i].world_p_antenna - centre).head(axes).transpose();
    b[row] = term(distances[i]) - mean;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto& spread = svd.singularValues();
  if (!(spread[axes - 1] > kLeastSpread * spread[0])) return std::nullopt;
  Eigen::Vector3d p = centre;
  p.head(axes) += svd.solve(b);
  return p;
}

}  // namespace

std::vector<std::optional<Eigen::Vector3d>> landmarkGuess(const PoseGraph& graph,
                                                          const std::vector<Pose3>& world_T_base,
                                                          const std::vector<bool>& admitted) {
  const std::vector<Evidence> evidence = collect(graph, world_T_base, admitted);
  std::vector<std::optional<Eigen::Vector3d>> guess;
  for (LandmarkIndex i = 0; i < evidence.size(); ++i) {
    if (graph.landmarks()[i].known)
      guess.emplace_back(graph.landmarks()[i].world_p);
    else if (!evidence[i].sightings.empty())
      guess.emplace_back(median(evidence[i].sightings));
    else
      guess.push_back(multilaterate(evidence[i].distances, graph.planar() ? 2 : 3));
  }
  return guess;
}

}  // namespace lamp
