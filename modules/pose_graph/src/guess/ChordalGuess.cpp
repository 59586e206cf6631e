#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <map>

#include "lamp/pose_graph/InitialGuess.h"
#include "solver/BlockCholesky.h"
#include "solver/GaugeAnchors.h"

namespace lamp {

namespace {

using Vectors = std::vector<Eigen::Vector3d>;

/** Asks for `to = by · from + offset`, where each node has one vector. */
struct LinearEdge {
  size_t from, to;  ///< places of the nodes
  double weight;
  Eigen::Matrix3d by;
};

/** Least squares over such edges, with some nodes held. The matrix is factorised once for several
 * sets of offsets. */
class VectorField {
 public:
  VectorField(std::vector<LinearEdge> edges, const std::vector<bool>& held)
      : edges_(std::move(edges)), row_(held.size(), -1) {
    int size = 0;
    for (size_t i = 0; i < held.size(); ++i)
      if (!held[i]) row_[i] = size++;
    matrix_.diagonal.assign(size, Eigen::Matrix3d::Zero());
    std::map<std::pair<int, int>, size_t> known;
    for (const LinearEdge& edge : edges_) add(edge, known);
    cholesky_.emplace(matrix_);
    solvable_ = cholesky_->factorize(matrix_, 1e-12);
  }

  /** \param values by node; in: of those that are held, out: of all. Unchanged if the problem is
   * singular. */
  void solve(const Vectors& offsets, Vectors& values) const {
    if (!solvable_) return;
    Eigen::VectorXd x =
        Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(matrix_.diagonal.size()));
    for (size_t e = 0; e < edges_.size(); ++e) {
      const LinearEdge& edge = edges_[e];
      const int from = row_[edge.from], to = row_[edge.to];
      Eigen::Vector3d known = offsets[e];
      if (from < 0) known += edge.by * values[edge.from];
      if (to < 0) known -= values[edge.to];
      if (from >= 0) x.segment<3>(3 * from) -= edge.weight * edge.by.transpose() * known;
      if (to >= 0) x.segment<3>(3 * to) += edge.weight * known;
    }
    cholesky_->solve(x);
    for (size_t i = 0; i < row_.size(); ++i)
      if (row_[i] >= 0) values[i] = x.segment<3>(3 * row_[i]);
  }

 private:
  void add(const LinearEdge& edge, std::map<std::pair<int, int>, size_t>& known) {
    const int from = row_[edge.from], to = row_[edge.to];
    if (from >= 0) matrix_.diagonal[from] += edge.weight * edge.by.transpose() * edge.by;
    if (to >= 0) matrix_.diagonal[to] += edge.weight * Eigen::Matrix3d::Identity();
    if (from < 0 || to < 0) return;
    const auto [found, is_new] = known.try_emplace(std::minmax(from, to), matrix_.pairs.size());
    if (is_new) {
      matrix_.pairs.push_back({std::min(from, to), std::max(from, to)});
      matrix_.off_diagonal.push_back(Eigen::Matrix3d::Zero());
    }
    matrix_.off_diagonal[found->second] -=
        edge.weight * (from < to ? Eigen::Matrix3d(edge.by.transpose()) : edge.by);
  }

  std::vector<LinearEdge> edges_;
  std::vector<int> row_;
  BlockMatrix<3> matrix_;
  std::optional<BlockCholesky<3>> cholesky_;
  bool solvable_ = false;
};

std::vector<const Edge*> relativeEdges(const PoseGraph& graph) {
  std::vector<const Edge*> edges;
  for (const Edge& edge : graph.edges())
    if (edge.joinsPoses() && edge.active()) edges.push_back(&edge);
  return edges;
}

/** Fixed nodes, nodes with a prior, and the first node of each component that has neither. */
std::vector<bool> heldNodes(const PoseGraph& graph) {
  std::vector<double> weights;
  std::vector<bool> held(graph.nodes().size(), false);
  for (const Edge& edge : graph.edges()) {
    weights.push_back(edge.active() ? 1.0 : 0.0);
    if (edge.type == EdgeType::kPrior) held[graph.place(edge.from)] = true;
  }
  for (const size_t anchor : gaugeAnchors(graph, weights)) held[anchor] = true;
  for (size_t i = 0; i < held.size(); ++i) held[i] = held[i] || graph.nodes()[i].fixed;
  return held;
}

/** Mean information of the translation (`first` = 0) or the rotation (3); never zero, so that each
 * edge joins its ends. */
double meanInformation(const Edge& edge, int first, bool planar) {
  const Vector6d diagonal = edge.information.diagonal();
  const double mean = planar ? (first == 0 ? diagonal.head<2>().mean() : diagonal[5])
                             : diagonal.segment<3>(first).mean();
  return std::max(mean, 1e-6);
}

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d sign(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

/** Replaces the rotations. Row k of the matrix is the node's vector: `to = from_R_toᵀ · from`. */
void solveRotations(const PoseGraph& graph, const std::vector<bool>& held,
                    std::vector<Pose3>& poses) {
  std::vector<LinearEdge> edges;
  for (const Edge* edge : relativeEdges(graph))
    edges.push_back({graph.place(edge->from), graph.place(edge->to),
                     meanInformation(*edge, 3, graph.planar()),
                     edge->from_T_to.linear().transpose()});
  const Vectors no_offsets(edges.size(), Eigen::Vector3d::Zero());
  const VectorField field(std::move(edges), held);
  for (int k = 0; k < 3; ++k) {
    Vectors rows;
    for (const Pose3& pose : poses) rows.push_back(pose.linear().row(k));
    field.solve(no_offsets, rows);
    for (size_t i = 0; i < poses.size(); ++i) poses[i].linear().row(k) = rows[i];
  }
  for (Pose3& pose : poses) pose.linear() = nearestRotation(pose.linear());
}

void solvePositions(const PoseGraph& graph, const std::vector<bool>& held,
                    std::vector<Pose3>& poses) {
  std::vector<LinearEdge> edges;
  Vectors offsets, positions;
  for (const Edge* edge : relativeEdges(graph)) {
    const size_t from = graph.place(edge->from);
    edges.push_back({from, graph.place(edge->to), meanInformation(*edge, 0, graph.planar()),
                     Eigen::Matrix3d::Identity()});
    offsets.push_back(poses[from].linear() * edge->from_T_to.translation());
  }
  for (const Pose3& pose : poses) positions.push_back(pose.translation());
  VectorField(std::move(edges), held).solve(offsets, positions);
  for (size_t i = 0; i < poses.size(); ++i) poses[i].translation() = positions[i];
}

}  // namespace

std::vector<Pose3> chordalGuess(const PoseGraph& graph) {
  std::vector<Pose3> poses = spanningTreeGuess(graph);
  const std::vector<bool> held = heldNodes(graph);
  solveRotations(graph, held, poses);
  solvePositions(graph, held, poses);
  return poses;
}

}  // namespace lamp
