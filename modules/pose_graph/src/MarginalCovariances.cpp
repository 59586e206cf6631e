#include "lamp/pose_graph/MarginalCovariances.h"

#include <stdexcept>
#include <unordered_map>

#include "BlockCholesky.h"
#include "GaugeAnchors.h"
#include "NormalEquations.h"

namespace lamp {

namespace {

/** What is added to the diagonal, absolutely and as a share, so that it can be factorised whatever
 * the edges do not know. */
constexpr double kLeastInformation = 1e-6, kLeastShare = 1e-12;
constexpr double kOutOfPlaneVariance = 1e-6;

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
  virtual std::vector<std::optional<Matrix6d>> relative(
      KeyframeId from, const std::vector<KeyframeId>& to) const = 0;
  virtual Matrix6d absolute(KeyframeId id) const = 0;
};

template <class Space>
class MarginalCovariances::ImplOf : public MarginalCovariances::Impl {
 public:
  explicit ImplOf(const PoseGraph& graph) {
    std::vector<PoseTerm<Space>> terms = poseTerms<Space>(graph);
    std::vector<double> weights;
    for (size_t e = 0; e < terms.size(); ++e) {
      terms[e].weight = graph.edges()[e].active() ? graph.edges()[e].weight : 0.0;
      weights.push_back(terms[e].weight);
    }
    gauge_ = gauges(graph, weights);
    std::vector<int> row;
    int size = 0;
    for (size_t i = 0; i < graph.nodes().size(); ++i) {
      place_.emplace(graph.nodes()[i].id, i);
      poses_.push_back(Space::fromPose3(normalized(graph.nodes()[i].world_T_base)));
      row.push_back(gauge_[i] == i ? -1 : size++);
    }
    NormalEquations<Space> equations(terms, row, size);
    equations.linearize(poses_);
    BlockMatrix<kDof> matrix = equations.matrix();
    for (auto& block : matrix.diagonal)
      block.diagonal() +=
          (kLeastShare * block.diagonal().array() + kLeastInformation).matrix().eval();
    row_ = std::move(row);
    cholesky_ = std::make_unique<BlockCholesky<kDof>>(matrix);
    if (!cholesky_->factorize(matrix, 0))
      throw std::runtime_error("the pose graph's information matrix cannot be factorised");
  }

  std::vector<std::optional<Matrix6d>> relative(KeyframeId from,
                                                const std::vector<KeyframeId>& to) const override {
    const size_t source = place_.at(from);
    const Column of_source = column(source);
    std::vector<std::optional<Matrix6d>> result;
    for (const KeyframeId id : to) {
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

  Matrix6d absolute(KeyframeId id) const override {
    Block sum = Block::Zero();
    for (const auto& item : column(place_.at(id))) sum += item.block.transpose() * item.block;
    return inSpace(sum);
  }

 private:
  static constexpr int kDof = Space::kDof;
  using Block = typename Space::Jacobian;
  using Column = std::vector<typename BlockCholesky<kDof>::InverseBlock>;

  /** Empty for a node that is held: it is known. */
  Column column(size_t node) const {
    return row_[node] < 0 ? Column() : cholesky_->inverseColumn(row_[node]);
  }

  /** Z Zᵀ, where Z is the two columns' sum after the relative pose's Jacobians. */
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

  std::unordered_map<KeyframeId, size_t> place_;
  std::vector<std::optional<size_t>> gauge_;
  std::vector<typename Space::Pose> poses_;
  std::vector<int> row_;  ///< of each node in the equations, -1 for held ones
  std::unique_ptr<BlockCholesky<kDof>> cholesky_;
};

MarginalCovariances::MarginalCovariances(const PoseGraph& graph) {
  if (graph.planar())
    impl_ = std::make_unique<ImplOf<Se2>>(graph);
  else
    impl_ = std::make_unique<ImplOf<Se3>>(graph);
}

MarginalCovariances::~MarginalCovariances() = default;

std::vector<std::optional<Matrix6d>> MarginalCovariances::relativeCovariances(
    KeyframeId from, const std::vector<KeyframeId>& to) const {
  return impl_->relative(from, to);
}

Matrix6d MarginalCovariances::covariance(KeyframeId id) const {
  return impl_->absolute(id);
}

}  // namespace lamp
