#include "solver/BlockCholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cstring>
#include <set>

#include "TestGraphs.h"
#include "solver/BlockKernels.h"

namespace lamp {
namespace {

/** A chain with some further pairs; positive definite. */
template <int kSize>
BlockMatrix<kSize> randomMatrix(Random& random, int size, int further) {
  using Block = typename BlockMatrix<kSize>::Block;
  BlockMatrix<kSize> matrix;
  std::set<std::pair<int, int>> taken;
  const auto add = [&](int row, int column) {
    if (row == column || !taken.insert({std::min(row, column), std::max(row, column)}).second)
      return;
    matrix.pairs.push_back({row, column});
  };
  for (int i = 1; i < size; ++i) add(i - 1, i);
  for (int i = 0; i < further; ++i)
    add(static_cast<int>(random.below(size)), static_cast<int>(random.below(size)));
  const auto noise = [&] {
    return Block(Block::NullaryExpr([&](Eigen::Index) { return random.normal(); }));
  };
  for (int i = 0; i < size; ++i) {
    const Block block = noise();
    matrix.diagonal.push_back(block * block.transpose() + 20.0 * kSize * Block::Identity());
  }
  for (size_t i = 0; i < matrix.pairs.size(); ++i) matrix.off_diagonal.push_back(noise());
  return matrix;
}

template <int kSize>
Eigen::MatrixXd dense(const BlockMatrix<kSize>& matrix) {
  const auto size = static_cast<Eigen::Index>(kSize * matrix.diagonal.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(size, size);
  for (size_t i = 0; i < matrix.diagonal.size(); ++i)
    result.block<kSize, kSize>(kSize * i, kSize * i) = matrix.diagonal[i];
  for (size_t i = 0; i < matrix.pairs.size(); ++i) {
    const auto [row, column] = matrix.pairs[i];
    result.block<kSize, kSize>(kSize * row, kSize * column) = matrix.off_diagonal[i];
    result.block<kSize, kSize>(kSize * column, kSize * row) = matrix.off_diagonal[i].transpose();
  }
  return result;
}

template <int kSize>
void expectSolvesAsDense() {
  Random random(1);
  for (const int size : {1, 2, 17, 60}) {
    const BlockMatrix<kSize> matrix = randomMatrix<kSize>(random, size, size);
    const double damping = 0.3;
    Eigen::MatrixXd damped = dense(matrix);
    damped.diagonal() *= 1.0 + damping;
    const Eigen::VectorXd right =
        Eigen::VectorXd::NullaryExpr(damped.rows(), [&](Eigen::Index) { return random.normal(); });
    for (const BlockKernels* kernels : availableBlockKernels()) {
      BlockCholesky<kSize> cholesky(matrix, *kernels);
      ASSERT_TRUE(cholesky.factorize(matrix, damping));
      Eigen::VectorXd x = right;
      cholesky.solve(x);
      EXPECT_LT((damped * x - right).norm(), 1e-10 * right.norm()) << kernels->instruction_set;
    }
  }
}

TEST(BlockCholesky, SolvesAsADenseFactorisationDoes) {
  expectSolvesAsDense<3>();
  expectSolvesAsDense<6>();
}

template <int kSize>
void expectSelectedInverse() {
  Random random(4);
  for (const int size : {1, 2, 40}) {
    const BlockMatrix<kSize> matrix = randomMatrix<kSize>(random, size, size);
    BlockCholesky<kSize> cholesky(matrix);
    ASSERT_TRUE(cholesky.factorize(matrix, 0));
    const Eigen::MatrixXd inverse = dense(matrix).inverse();
    const auto selected = cholesky.selectedInverse();
    const SymbolicCholesky& symbolic = cholesky.symbolic();
    const auto expectBlock = [&](int row, int column) {
      const int i = symbolic.place(row), j = symbolic.place(column);
      const auto& block = selected[symbolic.entry(std::max(i, j), std::min(i, j))];
      const Eigen::MatrixXd expected = inverse.block<kSize, kSize>(kSize * (i >= j ? row : column),
                                                                   kSize * (i >= j ? column : row));
      EXPECT_LT((block - expected).norm(), 1e-12) << row << " " << column;
    };
    for (int row = 0; row < size; ++row) expectBlock(row, row);
    for (const BlockPair pair : matrix.pairs) expectBlock(pair.row, pair.column);
  }
}

TEST(BlockCholesky, SelectedInverseIsThatOfTheDenseMatrix) {
  expectSelectedInverse<3>();
  expectSelectedInverse<6>();
}

template <int kSize>
void expectInverseColumns() {
  Random random(3);
  const BlockMatrix<kSize> matrix = randomMatrix<kSize>(random, 30, 20);
  BlockCholesky<kSize> cholesky(matrix);
  ASSERT_TRUE(cholesky.factorize(matrix, 0));
  const Eigen::MatrixXd inverse = dense(matrix).inverse();
  for (const int a : {0, 7, 29})
    for (const int b : {0, 12, 29}) {
      typename BlockMatrix<kSize>::Block sum = decltype(sum)::Zero();
      for (const auto& x : cholesky.inverseColumn(a))
        for (const auto& y : cholesky.inverseColumn(b))
          if (x.place == y.place) sum += x.block.transpose() * y.block;
      const auto expected = inverse.block<kSize, kSize>(kSize * a, kSize * b);
      EXPECT_LT((sum - expected).norm(), 1e-12 * inverse.norm());
    }
}

TEST(BlockCholesky, ColumnsOfTheInverseFactorGiveBlocksOfTheInverse) {
  expectInverseColumns<3>();
  expectInverseColumns<6>();
}

TEST(BlockCholesky, RefusesWhatIsNotPositiveDefinite) {
  Random random(2);
  BlockMatrix<6> matrix = randomMatrix<6>(random, 10, 5);
  BlockCholesky<6> cholesky(matrix);
  ASSERT_TRUE(cholesky.factorize(matrix, 0.0));
  matrix.diagonal[4](2, 2) = -1.0;
  EXPECT_FALSE(cholesky.factorize(matrix, 0.0));
  matrix.diagonal[4](2, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(cholesky.factorize(matrix, 0.0));
}

TEST(BlockCholesky, RefusesWhatIsSingularButForRounding) {
  BlockMatrix<3> matrix;  // a chain that nothing holds
  const Eigen::Matrix3d information = Eigen::Vector3d(7, 3, 11).asDiagonal();
  matrix.diagonal = {information, 2 * information, information};
  matrix.pairs = {{0, 1}, {1, 2}};
  matrix.off_diagonal = {-information, -information};
  BlockCholesky<3> cholesky(matrix);
  EXPECT_FALSE(cholesky.factorize(matrix, 0.0));
  EXPECT_TRUE(cholesky.factorize(matrix, 1e-6));
}

TEST(BlockCholesky, EmptyMatrix) {
  const BlockMatrix<6> matrix;
  BlockCholesky<6> cholesky(matrix);
  EXPECT_TRUE(cholesky.factorize(matrix, 0.0));
  Eigen::VectorXd x(0);
  cholesky.solve(x);
}

TEST(SymbolicCholesky, ChainHasNoFillIn) {
  std::vector<BlockPair> pairs;
  for (int i = 1; i < 100; ++i) pairs.push_back({i, i - 1});
  const SymbolicCholesky symbolic(100, pairs);
  EXPECT_EQ(symbolic.rows().size(), 100 + pairs.size());
}

TEST(SymbolicCholesky, HubIsEliminatedLast) {
  std::vector<BlockPair> pairs;
  for (int i = 1; i < 50; ++i) pairs.push_back({0, i});
  EXPECT_EQ(SymbolicCholesky(50, pairs).rows().size(), 50 + pairs.size());
}

}  // namespace
}  // namespace lamp
