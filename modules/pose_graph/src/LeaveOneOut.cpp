#include "LeaveOneOut.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <unordered_map>

#include "BlockCholesky.h"
#include "NormalEquations.h"

namespace lamp {

namespace {

/** Where a partner's bound is sought. */
constexpr int kPartnerNodes = 10;
constexpr size_t kPartners = 2;

template <class Space>
class LeaveOneOut {
 public:
  LeaveOneOut(const PoseGraph& graph, const std::vector<Pose3>& poses,
              const std::vector<bool>& taking_part)
      : terms_(poseTerms<Space>(graph)),
        unknowns_(findUnknowns(graph, {taking_part.begin(), taking_part.end()})) {
    for (size_t e = 0; e < terms_.size(); ++e) terms_[e].weight = taking_part[e] ? 1.0 : 0.0;
    for (const Pose3& pose : poses) poses_.push_back(Space::fromPose3(pose));
    NormalEquations<Space> equations(terms_, unknowns_);
    equations.linearize(poses_);
    cholesky_ = std::make_unique<BlockCholesky<kDof>>(equations.matrix());
    regular_ = cholesky_->factorize(equations.matrix(), kLeastShare);
  }

  double distance2(EdgeIndex edge) {
    if (!regular_) return 0.0;
    const PoseTerm<Space>& term = terms_[edge];
    Block d_from = Block::Zero(), d_to;
    const auto error =
        term.error(poses_[term.from], poses_[term.to], term.isUnary() ? nullptr : &d_from, &d_to);
    // (Ω⁻¹ - S)⁻¹ = Ω (I - S Ω)⁻¹, which a singular Ω does not harm.
    const Block S = covariance(term, d_from, d_to);
    const Block redundancy = (1.0 + kLeastShare) * Block::Identity() - S * term.information;
    return error.dot(term.information * redundancy.partialPivLu().solve(error));
  }

 private:
  static constexpr int kDof = Space::kDof;
  /** So that what no other edge knows has a solution. */
  static constexpr double kLeastShare = 1e-9;
  using Block = typename Space::Jacobian;
  using Column = std::vector<typename BlockCholesky<kDof>::InverseBlock>;

  /** J H⁻¹ Jᵀ, as the sum of squares of the columns of the inverse factor after J. */
  Block covariance(const PoseTerm<Space>& term, const Block& d_from, const Block& d_to) {
    const Column& of_from = column(unknowns_.row[term.from]);
    const Column& of_to = column(unknowns_.row[term.to]);
    Block sum = Block::Zero();
    auto a = of_from.begin();
    auto b = of_to.begin();
    while (a != of_from.end() || b != of_to.end()) {
      const bool take_a = b == of_to.end() || (a != of_from.end() && a->place <= b->place);
      const bool take_b = a == of_from.end() || (b != of_to.end() && b->place <= a->place);
      Block Z = Block::Zero();
      if (take_a) Z.noalias() += a++->block * d_from.transpose();
      if (take_b) Z.noalias() += b++->block * d_to.transpose();
      sum.noalias() += Z.transpose() * Z;
    }
    return sum;
  }

  const Column& column(int row) {
    const auto [found, is_new] = columns_.try_emplace(row);
    if (is_new && row >= 0) found->second = cholesky_->inverseColumn(row);
    return found->second;
  }

  std::vector<PoseTerm<Space>> terms_;
  const Unknowns unknowns_;
  std::vector<typename Space::Pose> poses_;
  std::unique_ptr<BlockCholesky<kDof>> cholesky_;
  bool regular_ = false;
  std::unordered_map<int, Column> columns_;  ///< of rows that were asked for
};

template <class Space>
std::vector<double> distances2(const PoseGraph& graph, const std::vector<Pose3>& poses,
                               const std::vector<bool>& taking_part,
                               const std::vector<EdgeIndex>& edges) {
  LeaveOneOut<Space> leave_one_out(graph, poses, taking_part);
  std::vector<double> result;
  for (const EdgeIndex edge : edges) result.push_back(leave_one_out.distance2(edge));
  return result;
}

}  // namespace

std::vector<double> leaveOneOut2(const PoseGraph& graph, const std::vector<Pose3>& poses,
                                 const std::vector<bool>& taking_part,
                                 const std::vector<EdgeIndex>& edges) {
  return graph.planar() ? distances2<Se2>(graph, poses, taking_part, edges)
                        : distances2<Se3>(graph, poses, taking_part, edges);
}

LeaveOneOutBound::LeaveOneOutBound(const PoseGraph& graph, const std::vector<bool>& taking_part)
    : graph_(graph), chains_(graph), neighbourhoods_(chains_, kPartnerNodes) {
  for (EdgeIndex e = 0; e < graph.edges().size(); ++e)
    if (graph.edges()[e].isLoopClosure() && taking_part[e])
      neighbourhoods_.add(directed(e, graph.edges()[e], graph.planar()));
}

double LeaveOneOutBound::distance2(EdgeIndex index, const std::vector<Pose3>& poses) const {
  const Edge& edge = graph_.edges()[index];
  double bound = std::numeric_limits<double>::infinity();
  if (!edge.isLoopClosure()) return bound;
  const DirectedLoop loop = directed(index, edge, graph_.planar());
  const Vector6d error =
      logSE3(loop.measured.a_T_b.inverse() * poses[graph_.place(loop.from)].inverse() *
             poses[graph_.place(loop.to)]);
  // With S₋ of the others: r = Ω⁻¹ (Ω⁻¹ + S₋)⁻¹ e, so that eᵀ (Ω⁻¹ + S₋)⁻¹ e = rᵀ Ω r + (Ω r)ᵀ S₋ Ω
  // r.
  const Vector6d force = loop.measured.covariance.llt().solve(error);
  const auto consider = [&](const RelativePose& others) {
    bound = std::min(bound, error.dot(force) + force.dot(others.covariance * force));
  };
  if (const auto odometry = chains_.between(loop.from, loop.to)) consider(*odometry);
  for (const DirectedLoop& partner : neighbourhoods_.nearest(loop, kPartners))
    consider(otherWay(loop, partner, chains_));
  return bound;
}

}  // namespace lamp
