#pragma once

#include <vector>

#include "solver/BlockMatrix.h"
#include "solver/PoseTerm.h"
#include "solver/Unknowns.h"

namespace lamp {

/** The normal equations H d = -g of the terms that have a weight. The structure is fixed once:
 * weights may change later, but not to or from zero. */
template <class Space>
class NormalEquations {
 public:
  using Term = PoseTerm<Space>;
  using Pose = typename Space::Pose;
  static constexpr int kDof = Space::kDof;

  NormalEquations(const std::vector<Term>& terms, const Unknowns& unknowns);

  /** Computes H and g at the poses. \return the cost. */
  double linearize(const std::vector<Pose>& poses);
  double cost(const std::vector<Pose>& poses) const;

  const BlockMatrix<kDof>& matrix() const { return matrix_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }

 private:
  /** A term of the sum, and where its blocks go. */
  struct Place {
    const Term* term;
    int from, to;     ///< rows, -1 for none
    int pair;         ///< in matrix_.off_diagonal, -1 for none
    bool transposed;  ///< the pair's row is `to`
  };

  void addTerm(const Place& place, const std::vector<Pose>& poses);
  void holdWhatNoTermKnows(const std::vector<Pose>& poses);

  const Unknowns unknowns_;
  std::vector<Place> places_;
  BlockMatrix<kDof> matrix_;
  Eigen::VectorXd gradient_;
  double cost_ = 0;
};

extern template class NormalEquations<Se2>;
extern template class NormalEquations<Se3>;

}  // namespace lamp
