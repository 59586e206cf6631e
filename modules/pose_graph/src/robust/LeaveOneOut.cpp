#include "robust/LeaveOneOut.h"

#include <Eigen/LU>
#include <unordered_map>

#include "solver/SelectedInverse.h"

namespace lamp {

namespace {

/** Squared distances beyond this need not be exact: no threshold is larger. */
constexpr double kFarAway = 100.0;

/** Blocks of the inverse of the normal equations' matrix, for rows that terms join. */
template <int kDof>
class InverseBlocks {
 public:
  using Block = typename BlockMatrix<kDof>::Block;

  /** \param few whether so few blocks will be asked for that computing their columns costs less
   * than computing all blocks. */
  InverseBlocks(const BlockCholesky<kDof>& cholesky, bool few) : cholesky_(cholesky) {
    if (!few) selected_ = selectedInverse(cholesky);
  }

  /** The block of any two rows, joined by a term or not. */
  Block apart(int row, int column) { return product(columnOf(row), columnOf(column)); }

  Block operator()(int row, int column) {
    if (selected_.empty()) return apart(row, column);
    const SymbolicCholesky& symbolic = cholesky_.symbolic();
    const int i = symbolic.place(row), j = symbolic.place(column);
    if (i >= j) return selected_[symbolic.entry(i, j)];
    return selected_[symbolic.entry(j, i)].transpose();
  }

 private:
  using Column = std::vector<typename BlockCholesky<kDof>::InverseBlock>;

  const Column& columnOf(int row) {
    const auto [found, is_new] = columns_.try_emplace(row);
    if (is_new) found->second = cholesky_.inverseColumn(row);
    return found->second;
  }

  static Block product(const Column& a, const Column& b) {
    Block sum = Block::Zero();
    for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end();) {
      if (x->place == y->place) sum.noalias() += x->block.transpose() * y->block;
      const int place = x->place;
      if (place <= y->place) ++x;
      if (y->place <= place) ++y;
    }
    return sum;
  }

  const BlockCholesky<kDof>& cholesky_;
  std::vector<Block> selected_;
  std::unordered_map<int, Column> columns_;
};

/** A term compared with the solution. */
template <class Space>
struct Beside {
  using Block = typename Space::Jacobian;

  const PoseTerm<Space>& term;
  typename Space::Tangent error;
  Block d_from, d_to;
  int from, to;  ///< rows, -1 for none

  Beside(const PoseTerm<Space>& of, const std::vector<typename Space::Pose>& poses,
         const std::vector<int>& row)
      : term(of), d_from(Block::Zero()), from(of.isUnary() ? -1 : row[of.from]), to(row[of.to]) {
    error = of.error(poses[of.from], poses[of.to], of.isUnary() ? nullptr : &d_from, &d_to);
  }

  /** S = J H⁻¹ Jᵀ without the parts that involve both ends. */
  Block ofEnds(InverseBlocks<Space::kDof>& inverse) const {
    Block S = Block::Zero();
    if (to >= 0) S += d_to * inverse(to, to) * d_to.transpose();
    if (from >= 0) S += d_from * inverse(from, from) * d_from.transpose();
    return S;
  }
  Block ofBoth(const Block& between) const {
    const Block cross = d_from * between * d_to.transpose();
    return cross + cross.transpose();
  }
  bool twoEnds() const { return to >= 0 && from >= 0; }

  /** eᵀ (Ω⁻¹ + sign S)⁻¹ e, written so that Ω may be singular. */
  double distance2(const Block& S, double sign) const {
    constexpr double kLeastRedundancy = 1e-9;
    const Block M = (1.0 + kLeastRedundancy) * Block::Identity() + sign * S * term.information;
    return error.dot(term.information * M.partialPivLu().solve(error));
  }

  /** The distance of a term that takes part: its own share in the solution is taken out. */
  double withoutIt(InverseBlocks<Space::kDof>& inverse) const {
    Block S = ofEnds(inverse);
    if (twoEnds()) S += ofBoth(inverse(from, to));
    return distance2(S, -1.0);
  }

  /** The distance of a term that takes no part. The structure may not join its ends, so a lower
   * bound that does not need their cross-covariance comes first (cov(a - b) <= 2 cov(a) + 2
   * cov(b)): if large, it is enough. */
  double beyond(InverseBlocks<Space::kDof>& inverse, double enough) const {
    const Block S = ofEnds(inverse);
    if (!twoEnds()) return distance2(S, 1.0);
    const double least = distance2(2.0 * S, 1.0);
    return least > enough ? least : distance2(S + ofBoth(inverse.apart(from, to)), 1.0);
  }
};

}  // namespace

template <class Space>
std::vector<double> leaveOneOut2(const std::vector<PoseTerm<Space>>& terms,
                                 const std::vector<typename Space::Pose>& poses,
                                 const std::vector<int>& row,
                                 const BlockCholesky<Space::kDof>& cholesky,
                                 const std::vector<EdgeIndex>& edges) {
  constexpr size_t kFew = 20;
  InverseBlocks<Space::kDof> inverse(cholesky, edges.size() <= kFew);
  std::vector<double> distances2;
  for (const EdgeIndex edge : edges) {
    const Beside<Space> beside(terms[edge], poses, row);
    distances2.push_back(terms[edge].weight > 0 ? beside.withoutIt(inverse)
                                                : beside.beyond(inverse, kFarAway));
  }
  return distances2;
}

template std::vector<double> leaveOneOut2<Se2>(const std::vector<PoseTerm<Se2>>&,
                                               const std::vector<Se2::Pose>&,
                                               const std::vector<int>&, const BlockCholesky<3>&,
                                               const std::vector<EdgeIndex>&);
template std::vector<double> leaveOneOut2<Se3>(const std::vector<PoseTerm<Se3>>&,
                                               const std::vector<Se3::Pose>&,
                                               const std::vector<int>&, const BlockCholesky<6>&,
                                               const std::vector<EdgeIndex>&);

}  // namespace lamp
