#pragma once

#include <cholmod.h>

#include <stdexcept>

#include "solver/BlockMatrix.h"

namespace lamp {

/** CHOLMOD (Chen, Davis, Hager, Rajamanickam, ACM TOMS 2008) with its defaults: tries AMD and
 * METIS, chooses between simplicial and supernodal, and takes what BLAS is installed. */
class Cholmod {
 public:
  template <int kSize>
  explicit Cholmod(const BlockMatrix<kSize>& matrix) {
    cholmod_start(&common_);
    matrix_ = convert(matrix);
  }
  ~Cholmod() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_sparse(&matrix_, &common_);
    cholmod_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  void analyze() {
    cholmod_free_factor(&factor_, &common_);
    factor_ = cholmod_analyze(matrix_, &common_);
  }
  void factorize() {
    cholmod_factorize(matrix_, factor_, &common_);
    if (common_.status != CHOLMOD_OK) throw std::runtime_error("CHOLMOD cannot factorise");
  }
  Eigen::VectorXd solve(Eigen::VectorXd right) {
    cholmod_dense dense{};
    dense.nrow = dense.nzmax = dense.d = static_cast<size_t>(right.size());
    dense.ncol = 1;
    dense.x = right.data();
    dense.xtype = CHOLMOD_REAL;
    dense.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* solution = cholmod_solve(CHOLMOD_A, factor_, &dense, &common_);
    right = Eigen::Map<Eigen::VectorXd>(static_cast<double*>(solution->x), right.size());
    cholmod_free_dense(&solution, &common_);
    return right;
  }
  double gigaflops() const { return 1e-9 * common_.fl; }

 private:
  template <int kSize>
  cholmod_sparse* convert(const BlockMatrix<kSize>& matrix) {
    const size_t size = kSize * matrix.diagonal.size();
    const size_t count = kSize * kSize * (matrix.diagonal.size() + matrix.pairs.size());
    cholmod_triplet* triplets =
        cholmod_allocate_triplet(size, size, count, -1, CHOLMOD_REAL, &common_);
    const auto add = [&](int row, int column, double value) {
      static_cast<int*>(triplets->i)[triplets->nnz] = std::max(row, column);
      static_cast<int*>(triplets->j)[triplets->nnz] = std::min(row, column);
      static_cast<double*>(triplets->x)[triplets->nnz++] = value;
    };
    for (int c = 0; c < kSize; ++c)
      for (int r = 0; r < kSize; ++r) {
        for (size_t i = 0; i < matrix.pairs.size(); ++i)
          add(kSize * matrix.pairs[i].row + r, kSize * matrix.pairs[i].column + c,
              matrix.off_diagonal[i](r, c));
        for (int i = 0; r >= c && i < static_cast<int>(matrix.diagonal.size()); ++i)
          add(kSize * i + r, kSize * i + c, matrix.diagonal[i](r, c));
      }
    cholmod_sparse* result = cholmod_triplet_to_sparse(triplets, count, &common_);
    cholmod_free_triplet(&triplets, &common_);
    return result;
  }

  cholmod_common common_;
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
};

}  // namespace lamp
