#include "solver/NormalEquations.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace lamp {

namespace {

/** Numbers the pairs of rows as they come. */
class PairTable {
 public:
  explicit PairTable(std::vector<BlockPair>& pairs) : pairs_(pairs) {}

  int number(int a, int b) {
    const BlockPair pair{std::min(a, b), std::max(a, b)};
    const uint64_t key = static_cast<uint64_t>(pair.row) << 32 | static_cast<uint32_t>(pair.column);
    const auto [found, is_new] = numbers_.emplace(key, static_cast<int>(pairs_.size()));
    if (is_new) pairs_.push_back(pair);
    return found->second;
  }

 private:
  std::vector<BlockPair>& pairs_;
  std::unordered_map<uint64_t, int> numbers_;
};

}  // namespace

template <class Space>
NormalEquations<Space>::NormalEquations(const std::vector<Term>& terms, const Unknowns& unknowns)
    : unknowns_(unknowns), gradient_(kDof * unknowns.size) {
  const std::vector<int>& row = unknowns.row;
  PairTable table(matrix_.pairs);
  for (const Term& term : terms) {
    if (term.weight <= 0) continue;
    Place place{&term, term.isUnary() ? -1 : row[term.from], row[term.to], -1, false};
    if (place.from >= 0 && place.to >= 0) {
      place.pair = table.number(place.from, place.to);
      place.transposed = place.from > place.to;
    }
    places_.push_back(place);
  }
  matrix_.diagonal.resize(unknowns.size);
  matrix_.off_diagonal.resize(matrix_.pairs.size());
}

template <class Space>
double NormalEquations<Space>::linearize(const std::vector<Pose>& poses) {
  matrix_.setZero();
  gradient_.setZero();
  cost_ = 0;
  for (const Place& place : places_) addTerm(place, poses);
  holdWhatNoTermKnows(poses);
  return cost_;
}

/** The gradient is zero in directions that no term knows, and so is the step, whatever the
 * stiffness given to them. */
template <class Space>
void NormalEquations<Space>::holdWhatNoTermKnows(const std::vector<Pose>& poses) {
  for (int row = unknowns_.first_landmark_row; row < unknowns_.size; ++row)
    for (int axis = Space::kPositionDof; axis < kDof; ++axis)
      matrix_.diagonal[row](axis, axis) = 1.0;
  for (const size_t node : unknowns_.level_anchors) {
    auto& block = matrix_.diagonal[unknowns_.row[node]];
    block += block.trace() * Space::positionAndYaw(poses[node]);
  }
}

template <class Space>
void NormalEquations<Space>::addTerm(const Place& place, const std::vector<Pose>& poses) {
  using Jacobian = typename Space::Jacobian;
  const Term& term = *place.term;
  Jacobian d_from, d_to;
  const typename Space::Tangent error =
      term.error(poses[term.from], poses[term.to], &d_from, &d_to);
  const Jacobian information = term.weight * term.information;
  const typename Space::Tangent force = information * error;
  cost_ += 0.5 * error.dot(force);
  const auto part = [&](int row) { return gradient_.segment<kDof>(kDof * row); };
  if (place.from >= 0) {
    matrix_.diagonal[place.from].noalias() += d_from.transpose() * (information * d_from).eval();
    part(place.from).noalias() += d_from.transpose() * force;
  }
  if (place.to < 0) return;
  const Jacobian stiff = information * d_to;
  matrix_.diagonal[place.to].noalias() += d_to.transpose() * stiff;
  part(place.to).noalias() += d_to.transpose() * force;
  if (place.pair < 0) return;
  auto& block = matrix_.off_diagonal[place.pair];
  if (place.transposed)
    block.noalias() += stiff.transpose() * d_from;
  else
    block.noalias() += d_from.transpose() * stiff;
}

template <class Space>
double NormalEquations<Space>::cost(const std::vector<Pose>& poses) const {
  double sum = 0;
  for (const Place& place : places_) {
    const Term& term = *place.term;
    sum += term.weight * term.chi2(poses[term.from], poses[term.to]);
  }
  return 0.5 * sum;
}

template class NormalEquations<Se2>;
template class NormalEquations<Se3>;

}  // namespace lamp
