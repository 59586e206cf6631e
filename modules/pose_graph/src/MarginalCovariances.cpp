#include "lamp/pose_graph/MarginalCovariances.h"

#include <mutex>
#include <stdexcept>
#include <unordered_map>

#include "solver/BlockCholesky.h"
#include "solver/GaugeAnchors.h"
#include "solver/NormalEquations.h"
#include "solver/SelectedInverse.h"
#include "solver/Unknowns.h"

namespace lamp {

namespace {

/** Added to the diagonal, as a constant and as a share of it, so that the matrix can be factorised
 * whatever directions no edge measures. */
constexpr double kLeastInformation = 1e-6, kLeastShare = 1e-12;
constexpr double kOutOfPlaneVariance = 1e-6;

/** Edges other than loop closures that may be rejected count only once the optimiser has kept them:
 * what they measure may not have a place before. */
bool counts(const PoseGraph& graph, const Edge& edge) {
  if (edge.endsAtLandmark() && !graph.landmarks()[edge.landmark].placed) return false;
  if (edge.mayBeRejected() && !edge.isLoopClosure()) return edge.verdict == Verdict::kInlier;
  return edge.active();
}

Matrix6d inSpace(const Matrix6d& covariance) {
  return covariance;
}

Matrix6d inSpace(const Eigen::Matrix3d& covariance) {
  Matrix6d result = kOutOfPlaneVariance * Matrix6d::Identity();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      result(kPlanarAxes[row], kPlanarAxes[column]) = covariance(row, column);
  return result;
}

}  // namespace

class MarginalCovariances::Impl {
 public:
  virtual ~Impl() = default;
  virtual std::vector<std::optional<Matrix6d>> relative(KeyNodeId from,
                                                        const std::vector<KeyNodeId>& to) const = 0;
  virtual Matrix6d absolute(KeyNodeId id) const = 0;
  virtual std::vector<Matrix6d> ofNodes() const = 0;
  virtual Eigen::Matrix3d ofLandmark(LandmarkIndex landmark) const = 0;
};

template <class Space>
class MarginalCovariances::ImplOf : public MarginalCovariances::Impl {
 public:
  explicit ImplOf(const PoseGraph& graph) {
    std::vector<PoseTerm<Space>> terms = poseTerms<Space>(graph);
    std::vector<double> weights;
    for (size_t e = 0; e < terms.size(); ++e) {
      terms[e].weight = counts(graph, graph.edges()[e]) ? graph.edges()[e].weight : 0.0;
      weights.push_back(terms[e].weight);
    }
    gauge_ = gauges(graph, weights);
    for (size_t i = 0; i < graph.nodes().size(); ++i) {
      place_.emplace(graph.nodes()[i].id, i);
      poses_.push_back(Space::fromPose3(normalized(graph.nodes()[i].world_T_base)));
    }
    for (const Landmark& landmark : graph.landmarks())
      poses_.push_back(Space::fromPose3(Pose3(Eigen::Translation3d(landmark.world_p))));
    const Unknowns unknowns = findUnknowns(graph, weights);
    NormalEquations<Space> equations(terms, unknowns);
    equations.linearize(poses_);
    matrix_ = equations.matrix();
    for (auto& block : matrix_.diagonal)
      block.diagonal() +=
          (kLeastShare * block.diagonal().array() + kLeastInformation).matrix().eval();
    row_ = unknowns.row;
  }

  std::vector<std::optional<Matrix6d>> relative(KeyNodeId from,
                                                const std::vector<KeyNodeId>& to) const override {
    const size_t source = place_.at(from);
    const Column of_source = column(source);
    std::vector<std::optional<Matrix6d>> result;
    for (const KeyNodeId id : to) {
      const size_t target = place_.at(id);
      if (target == source)
        result.emplace_back(Matrix6d::Zero());
      else if (gauge_[source] != gauge_[target])
        result.emplace_back();
      else
        result.emplace_back(relative(source, of_source, target));
    }
    return result;
  }

  Matrix6d absolute(KeyNodeId id) const override { return absolute(place_.at(id)); }

  std::vector<Matrix6d> ofNodes() const override {
    const BlockCholesky<kDof>& factor = cholesky();
    const SymbolicCholesky& symbolic = factor.symbolic();
    const std::vector<Block> inverse = selectedInverse(factor);
    std::vector<Matrix6d> result;
    for (size_t i = 0; i < place_.size(); ++i) {
      if (row_[i] < 0) {
        result.push_back(inSpace(Block(Block::Zero())));
        continue;
      }
      const int place = symbolic.place(row_[i]);
      result.push_back(inSpace(inverse[symbolic.entry(place, place)]));
    }
    return result;
  }

  Eigen::Matrix3d ofLandmark(LandmarkIndex landmark) const override {
    if (row_.at(place_.size() + landmark) < 0) return Eigen::Matrix3d::Zero();
    return absolute(place_.size() + landmark).template topLeftCorner<3, 3>();
  }

 private:
  static constexpr int kDof = Space::kDof;
  using Block = typename Space::Jacobian;
  using Column = std::vector<typename BlockCholesky<kDof>::InverseBlock>;

  /** Empty for a node that is held: its pose is known. */
  Column column(size_t node) const {
    return row_[node] < 0 ? Column() : cholesky().inverseColumn(row_[node]);
  }

  const BlockCholesky<kDof>& cholesky() const {
    std::call_once(factorized_, [this] {
      cholesky_ = std::make_unique<BlockCholesky<kDof>>(matrix_);
      if (!cholesky_->factorize(matrix_, 0))
        throw std::runtime_error("the pose graph's information matrix cannot be factorised");
    });
    return *cholesky_;
  }

  Matrix6d absolute(size_t place) const {
    Block sum = Block::Zero();
    for (const auto& item : column(place)) sum += item.block.transpose() * item.block;
    return inSpace(sum);
  }

  /** Zᵀ Z, where Z is the sum of both nodes' columns, each times its transposed Jacobian of the
   * relative pose. */
  Matrix6d relative(size_t from, const Column& of_from, size_t to) const {
    const Pose3 from_T_to = Space::toPose3(poses_[from]).inverse() * Space::toPose3(poses_[to]);
    Block d_from, d_to;
    Space::relativeError(Space::fromPose3(from_T_to), poses_[from], poses_[to], &d_from, &d_to);
    const Column of_to = column(to);
    Block sum = Block::Zero();
    auto a = of_from.begin();
    auto b = of_to.begin();
    while (a != of_from.end() || b != of_to.end()) {
      const bool take_a = b == of_to.end() || (a != of_from.end() && a->place <= b->place);
      const bool take_b = a == of_from.end() || (b != of_to.end() && b->place <= a->place);
      Block Z = Block::Zero();
      if (take_a) Z += a++->block * d_from.transpose();
      if (take_b) Z += b++->block * d_to.transpose();
      sum += Z.transpose() * Z;
    }
    return inSpace(sum);
  }

  std::unordered_map<KeyNodeId, size_t> place_;
  std::vector<std::optional<size_t>> gauge_;
  std::vector<typename Space::Pose> poses_;
  std::vector<int> row_;  ///< of each pose in the equations, -1 for held ones
  BlockMatrix<kDof> matrix_;
  mutable std::once_flag factorized_;
  mutable std::unique_ptr<BlockCholesky<kDof>> cholesky_;  ///< made by the first query
};

MarginalCovariances::MarginalCovariances(const PoseGraph& graph) {
  if (graph.planar())
    impl_ = std::make_unique<ImplOf<Se2>>(graph);
  else
    impl_ = std::make_unique<ImplOf<Se3>>(graph);
}

MarginalCovariances::~MarginalCovariances() = default;

std::vector<std::optional<Matrix6d>> MarginalCovariances::relativeCovariances(
    KeyNodeId from, const std::vector<KeyNodeId>& to) const {
  return impl_->relative(from, to);
}

Matrix6d MarginalCovariances::covariance(KeyNodeId id) const {
  return impl_->absolute(id);
}

std::vector<Matrix6d> MarginalCovariances::covariances() const {
  return impl_->ofNodes();
}

Eigen::Matrix3d MarginalCovariances::landmarkCovariance(LandmarkIndex landmark) const {
  return impl_->ofLandmark(landmark);
}

}  // namespace lamp
