#include "lamp/pose_graph/ShortestPathUncertainty.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace lamp {

namespace {

constexpr double kLeverArmM = 10.0;
constexpr double kOutOfPlaneVariance = 1e-6;

double pathCost(const Matrix6d& covariance) {
  const Vector6d variances = covariance.diagonal();
  return variances.head<3>().sum() + kLeverArmM * kLeverArmM * variances.tail<3>().sum();
}

/** Inverse of a matrix, if it is positive definite beyond rounding. */
template <class Matrix>
std::optional<Matrix> invert(const Matrix& m) {
  // Scaled to a unit diagonal, since metres and radians differ widely.
  const auto scale = m.diagonal().cwiseSqrt().eval();
  if (!(scale.minCoeff() > 0)) return std::nullopt;
  const Matrix scaled = scale.cwiseInverse().asDiagonal() * m * scale.cwiseInverse().asDiagonal();
  const Eigen::LDLT<Matrix> ldlt(scaled);
  if (!(ldlt.vectorD().minCoeff() > 1e-12)) return std::nullopt;
  const Matrix inverse = ldlt.solve(Matrix::Identity());
  return Matrix(scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal());
}

std::optional<Matrix6d> planarCovariance(const Matrix6d& information) {
  Eigen::Matrix3d planar;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      planar(row, column) = information(kPlanarAxes[row], kPlanarAxes[column]);
  const std::optional<Eigen::Matrix3d> inverse = invert(planar);
  if (!inverse) return std::nullopt;
  Matrix6d covariance = kOutOfPlaneVariance * Matrix6d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      covariance(kPlanarAxes[row], kPlanarAxes[column]) = (*inverse)(row, column);
  return covariance;
}

}  // namespace

ShortestPathUncertainty::ShortestPathUncertainty(const PoseGraph& graph)
    : links_(graph.nodes().size() + 1) {
  const bool planar = graph.planar();
  for (const Node& node : graph.nodes()) {
    vertex_.emplace(node.id, world_T_vertex_.size());
    world_T_vertex_.push_back(node.world_T_base);
  }
  const size_t world = world_T_vertex_.size();
  world_T_vertex_.push_back(Pose3::Identity());

  for (const Edge& edge : graph.edges()) {
    if (!edge.active() || edge.weight <= 0) continue;
    const std::optional<Matrix6d> covariance =
        planar ? planarCovariance(edge.information) : invert(edge.information);
    if (!covariance) continue;
    const bool prior = edge.type == EdgeType::kPrior;
    addEdge(prior ? world : vertex_.at(edge.from), vertex_.at(edge.to), *covariance);
  }
}

void ShortestPathUncertainty::addEdge(size_t from, size_t to, const Matrix6d& covariance) {
  const double cost = pathCost(covariance);
  links_[from].push_back({to, covariances_.size(), false, cost});
  links_[to].push_back({from, covariances_.size(), true, cost});
  covariances_.push_back(covariance);
}

Matrix6d ShortestPathUncertainty::extend(const Matrix6d& covariance, size_t at,
                                         const Link& link) const {
  const Pose3 at_T_next = world_T_vertex_[at].inverse() * world_T_vertex_[link.to];
  const Matrix6d& edge = covariances_[link.edge];
  if (!link.backward) return composeCovariance(covariance, at_T_next, edge);
  // (T · Exp(d))⁻¹ = T⁻¹ · Exp(-Ad(T) d), with T = next_T_at.
  const Matrix6d A = adjoint(at_T_next.inverse());
  return composeCovariance(covariance, at_T_next, A * edge * A.transpose());
}

std::vector<std::optional<Matrix6d>> ShortestPathUncertainty::relativeCovariances(
    KeyframeId from, const std::vector<KeyframeId>& to) const {
  struct Reached {
    double cost = std::numeric_limits<double>::infinity();
    size_t parent = 0;
    const Link* link = nullptr;
    std::optional<Matrix6d> covariance;  ///< of from_T_this; set once the cost is final
  };
  std::vector<Reached> reached(world_T_vertex_.size());
  std::vector<bool> wanted(world_T_vertex_.size(), false);
  size_t open_targets = 0;
  for (const KeyframeId id : to) {
    const size_t target = vertex_.at(id);
    if (!wanted[target]) ++open_targets;
    wanted[target] = true;
  }

  using Entry = std::pair<double, size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  const size_t source = vertex_.at(from);
  reached[source].cost = 0;
  queue.emplace(0.0, source);
  while (!queue.empty() && open_targets > 0) {
    const auto [cost, at] = queue.top();
    queue.pop();
    Reached& here = reached[at];
    if (here.covariance) continue;
    here.covariance = here.link ? extend(*reached[here.parent].covariance, here.parent, *here.link)
                                : Matrix6d(Matrix6d::Zero());
    if (wanted[at]) --open_targets;
    for (const Link& link : links_[at]) {
      Reached& next = reached[link.to];
      if (cost + link.cost >= next.cost) continue;
      next.cost = cost + link.cost;
      next.parent = at;
      next.link = &link;
      queue.emplace(next.cost, link.to);
    }
  }

  std::vector<std::optional<Matrix6d>> result;
  for (const KeyframeId id : to) result.push_back(reached[vertex_.at(id)].covariance);
  return result;
}

}  // namespace lamp
