#include "LeaveOneOut.h"

#include <Eigen/LU>
#include <algorithm>

#include "BlockCholesky.h"
#include "NormalEquations.h"

namespace lamp {

namespace {

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
    if (cholesky_->factorize(equations.matrix(), kLeastShare))
      inverse_ = cholesky_->selectedInverse();
  }

  double distance2(EdgeIndex edge) const {
    if (inverse_.empty()) return 0.0;
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

  /** S = J H⁻¹ Jᵀ */
  Block covariance(const PoseTerm<Space>& term, const Block& d_from, const Block& d_to) const {
    const int from = unknowns_.row[term.from], to = unknowns_.row[term.to];
    Block S = Block::Zero();
    if (to >= 0) S += d_to * inverse(to, to) * d_to.transpose();
    if (from < 0 || term.isUnary()) return S;
    S += d_from * inverse(from, from) * d_from.transpose();
    if (to < 0) return S;
    const Block cross = d_from * inverse(from, to) * d_to.transpose();
    return S + cross + cross.transpose();
  }

  /** Of two rows that a term joins. */
  Block inverse(int row, int column) const {
    const SymbolicCholesky& symbolic = cholesky_->symbolic();
    const int i = symbolic.place(row), j = symbolic.place(column);
    if (i >= j) return inverse_[symbolic.entry(i, j)];
    return inverse_[symbolic.entry(j, i)].transpose();
  }

  std::vector<PoseTerm<Space>> terms_;
  const Unknowns unknowns_;
  std::vector<typename Space::Pose> poses_;
  std::unique_ptr<BlockCholesky<kDof>> cholesky_;
  std::vector<Block> inverse_;  ///< BlockCholesky::selectedInverse(); empty if there is none
};

template <class Space>
std::vector<double> distances2(const PoseGraph& graph, const std::vector<Pose3>& poses,
                               const std::vector<bool>& taking_part,
                               const std::vector<EdgeIndex>& edges) {
  const LeaveOneOut<Space> leave_one_out(graph, poses, taking_part);
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

}  // namespace lamp
