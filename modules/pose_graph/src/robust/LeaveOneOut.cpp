#include "robust/LeaveOneOut.h"

#include <Eigen/LU>
#include <unordered_map>

#include "solver/SelectedInverse.h"

namespace lamp {

namespace {

/** Blocks of the inverse of the normal equations' matrix, for rows that terms join. */
template <int kDof>
class InverseBlocks {
 public:
  using Block = typename BlockMatrix<kDof>::Block;

  /** \param few whether so few blocks will be asked for that their columns cost less than all. */
  InverseBlocks(const BlockCholesky<kDof>& cholesky, bool few) : cholesky_(cholesky) {
    if (!few) selected_ = selectedInverse(cholesky);
  }

  Block operator()(int row, int column) {
    if (selected_.empty()) return product(columnOf(row), columnOf(column));
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

/** S = J H⁻¹ Jᵀ of a term. */
template <class Space>
typename Space::Jacobian covariance(InverseBlocks<Space::kDof>& inverse, int from, int to,
                                    const typename Space::Jacobian& d_from,
                                    const typename Space::Jacobian& d_to) {
  using Block = typename Space::Jacobian;
  Block S = Block::Zero();
  if (to >= 0) S += d_to * inverse(to, to) * d_to.transpose();
  if (from >= 0) S += d_from * inverse(from, from) * d_from.transpose();
  if (to < 0 || from < 0) return S;
  const Block cross = d_from * inverse(from, to) * d_to.transpose();
  return S + cross + cross.transpose();
}

}  // namespace

template <class Space>
std::vector<double> leaveOneOut2(const std::vector<PoseTerm<Space>>& terms,
                                 const std::vector<typename Space::Pose>& poses,
                                 const std::vector<int>& row,
                                 const BlockCholesky<Space::kDof>& cholesky,
                                 const std::vector<EdgeIndex>& edges) {
  using Block = typename Space::Jacobian;
  constexpr size_t kFew = 20;
  constexpr double kLeastRedundancy = 1e-9;
  InverseBlocks<Space::kDof> inverse(cholesky, edges.size() <= kFew);
  std::vector<double> distances2;
  for (const EdgeIndex edge : edges) {
    const PoseTerm<Space>& term = terms[edge];
    Block d_from = Block::Zero(), d_to;
    const auto error =
        term.error(poses[term.from], poses[term.to], term.isUnary() ? nullptr : &d_from, &d_to);
    const Block S = covariance<Space>(inverse, term.isUnary() ? -1 : row[term.from], row[term.to],
                                      d_from, d_to);
    // (Ω⁻¹ - S)⁻¹ = Ω (I - S Ω)⁻¹, which a singular Ω does not harm.
    const Block redundancy = (1.0 + kLeastRedundancy) * Block::Identity() - S * term.information;
    distances2.push_back(error.dot(term.information * redundancy.partialPivLu().solve(error)));
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
