#include "solver/SparseProblem.h"

#include "robust/LeaveOneOut.h"
#include "solver/FinitePoses.h"

namespace lamp {

template <class Space>
SparseProblem<Space>::SparseProblem(const PoseGraph& graph, const std::vector<Pose3>& poses,
                                    Minimizer minimizer)
    : graph_(graph), minimize_(minimizer), terms_(poseTerms<Space>(graph)) {
  setPoses(poses);
}

template <class Space>
void SparseProblem<Space>::setPoses(const std::vector<Pose3>& poses) {
  checkFinite(graph_, poses);
  factorized_here_ = false;
  poses_.clear();
  for (const Pose3& pose : poses) poses_.push_back(Space::fromPose3(normalized(pose)));
}

template <class Space>
std::vector<Pose3> SparseProblem<Space>::poses() const {
  std::vector<Pose3> result;
  for (const Pose& pose : poses_) result.push_back(Space::toPose3(pose));
  return result;
}

template <class Space>
void SparseProblem<Space>::setWeight(EdgeIndex edge, double weight) {
  if ((terms_[edge].weight > 0) != (weight > 0)) equations_.reset();
  if (terms_[edge].weight != weight) factorized_here_ = false;
  terms_[edge].weight = weight;
}

template <class Space>
std::vector<double> SparseProblem<Space>::leaveOneOut2(const std::vector<EdgeIndex>& edges) {
  if (!equations_) build();
  if (!factorized_here_) {
    linearize();
    if (!factorize(kNoDamping)) return std::vector<double>(edges.size(), 0.0);
  }
  return lamp::leaveOneOut2<Space>(terms_, poses_, row_, *cholesky_, edges);
}

template <class Space>
SolveSummary SparseProblem<Space>::solve(const SolverOptions& options) {
  if (!equations_) build();
  const std::vector<Pose> start = poses_;
  const SolveSummary summary = minimize_(*this, options);
  if (summary.usable) return summary;
  poses_ = start;
  factorized_here_ = false;
  return summary;
}

template <class Space>
void SparseProblem<Space>::build() {
  std::vector<double> weights;
  for (const PoseTerm<Space>& term : terms_) weights.push_back(term.weight);
  const Unknowns unknowns = findUnknowns(graph_, weights);
  row_ = unknowns.row;
  cholesky_.reset();  // before the next one takes its memory
  equations_ = std::make_unique<NormalEquations<Space>>(terms_, unknowns);
  cholesky_ = std::make_unique<BlockCholesky<Space::kDof>>(equations_->matrix());
  factorized_here_ = false;
}

template <class Space>
std::optional<double> SparseProblem<Space>::computeStep(double damping) {
  if (!factorize(damping)) return std::nullopt;
  const Eigen::VectorXd& gradient = equations_->gradient();
  step_ = -gradient;
  cholesky_->solve(step_);
  move();
  predicted_ = 0.5 * (damping * equations_->matrix().scaledNorm2(step_) - gradient.dot(step_));
  return predicted_;
}

template <class Space>
bool SparseProblem<Space>::factorize(double damping) {
  const bool done = cholesky_->factorize(equations_->matrix(), damping);
  factorized_here_ = done && damping <= kNoDamping;
  return done;
}

template <class Space>
void SparseProblem<Space>::move() {
  constexpr int kDof = Space::kDof;
  moved_ = poses_;
  for (size_t i = 0; i < row_.size(); ++i)
    if (row_[i] >= 0) moved_[i] = Space::plus(poses_[i], step_.segment<kDof>(kDof * row_[i]));
}

template <class Space>
double SparseProblem<Space>::costAfterStep() {
  constexpr double kGood = 0.5;
  const double cost = equations_->cost(moved_);
  if (cost_ - cost > kGood * predicted_) return cost;
  std::vector<Pose> as_chains = movedAsChains();
  const double other = equations_->cost(as_chains);
  if (!(other < cost)) return cost;
  moved_ = std::move(as_chains);
  return other;
}

/** Gives each link of odometry the error that the linearised problem predicts. */
template <class Space>
std::vector<typename Space::Pose> SparseProblem<Space>::movedAsChains() const {
  constexpr int kDof = Space::kDof;
  const Pose origin = Space::fromPose3(Pose3::Identity());
  std::vector<Pose> moved = moved_;
  for (const PoseTerm<Space>& link : terms_) {
    const size_t from = link.from, to = link.to;
    if (link.type != EdgeType::kOdometry || from >= to || row_[to] < 0) continue;
    typename Space::Jacobian d_from, d_to;
    typename Space::Tangent error = link.error(poses_[from], poses_[to], &d_from, &d_to);
    error += d_to * step_.segment<kDof>(kDof * row_[to]);
    if (row_[from] >= 0) error += d_from * step_.segment<kDof>(kDof * row_[from]);
    const Pose measured = Space::plus(moved[from], Space::minus(link.measured, origin));
    moved[to] = Space::plus(measured, error);
  }
  return moved;
}

template class SparseProblem<Se2>;
template class SparseProblem<Se3>;

}  // namespace lamp
