#include "solver/BlockCholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <set>

#include "TestGraphs.h"
#include "solver/BlockKernels.h"
#include "solver/EliminationOrder.h"
#include "solver/SelectedInverse.h"

namespace lamp {
namespace {

/** Symmetric and positive definite. */
template <int kSize>
BlockMatrix<kSize> matrixOf(Random& random, int size, const std::vector<BlockPair>& pairs) {
  using Block = typename BlockMatrix<kSize>::Block;
  BlockMatrix<kSize> matrix;
  matrix.pairs = pairs;
  const auto noise = [&] {
    return Block(Block::NullaryExpr([&](Eigen::Index) { return random.normal(); }));
  };
  for (size_t i = 0; i < pairs.size(); ++i) matrix.off_diagonal.push_back(noise());
  std::vector<int> neighbours(size, 1);
  for (const BlockPair pair : pairs) {
    ++neighbours[pair.row];
    ++neighbours[pair.column];
  }
  for (const int count : neighbours) {
    const Block block = noise();
    matrix.diagonal.push_back(block * block.transpose() + 5.0 * kSize * count * Block::Identity());
  }
  return matrix;
}

/** Random pairs of rows, a few times as many as rows or less. */
std::vector<BlockPair> randomPairs(Random& random, int size, int count) {
  std::set<std::pair<int, int>> taken;
  std::vector<BlockPair> pairs;
  for (int i = 0; i < count; ++i) {
    const auto a = static_cast<int>(random.below(size)), b = static_cast<int>(random.below(size));
    if (a != b && taken.insert({std::min(a, b), std::max(a, b)}).second) pairs.push_back({a, b});
  }
  return pairs;
}

std::vector<BlockPair> chain(int size) {
  std::vector<BlockPair> pairs;
  for (int i = 1; i < size; ++i) pairs.push_back({i, i - 1});
  return pairs;
}

std::vector<BlockPair> hub(int size) {
  std::vector<BlockPair> pairs;
  for (int i = 1; i < size; ++i) pairs.push_back({0, i});
  return pairs;
}

std::vector<BlockPair> allPairs(int begin, int end) {
  std::vector<BlockPair> pairs;
  for (int i = begin; i < end; ++i)
    for (int j = begin; j < i; ++j) pairs.push_back({j, i});
  return pairs;
}

/** The points of a lattice with their neighbours. */
std::vector<BlockPair> lattice(int side) {
  std::vector<BlockPair> pairs;
  for (int i = 0; i < side * side * side; ++i)
    for (const int step : {1, side, side * side})
      if (i / step % side + 1 < side) pairs.push_back({i, i + step});
  return pairs;
}

template <int kSize>
BlockMatrix<kSize> randomMatrix(Random& random, int size, int further) {
  std::vector<BlockPair> pairs = chain(size);
  for (const BlockPair pair : randomPairs(random, size, further))
    if (std::abs(pair.row - pair.column) > 1) pairs.push_back(pair);
  return matrixOf<kSize>(random, size, pairs);
}

/** Structures of all kinds: with panels of one column and such that are wider than one panel may
 * be; with fill-in and without. */
template <int kSize>
std::map<std::string, BlockMatrix<kSize>> matrices() {
  Random random(1);
  const auto make = [&](int size, const std::vector<BlockPair>& pairs) {
    return matrixOf<kSize>(random, size, pairs);
  };
  std::vector<BlockPair> apart = allPairs(3, 12);
  for (const BlockPair pair : chain(3)) apart.push_back(pair);
  return {{"one block", make(1, {})},
          {"two blocks", make(2, {{1, 0}})},
          {"diagonal", make(5, {})},
          {"chain", make(40, chain(40))},
          {"hub", make(40, hub(40))},
          {"apart", make(13, apart)},
          {"dense", make(70, allPairs(0, 70))},
          {"lattice", make(125, lattice(5))},
          {"sparse", randomMatrix<kSize>(random, 60, 60)},
          {"much fill-in", randomMatrix<kSize>(random, 100, 400)}};
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
  for (const auto& [name, matrix] : matrices<kSize>()) {
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
      EXPECT_LT((damped * x - right).norm(), 1e-10 * right.norm())
          << name << " " << kernels->instruction_set;
    }
  }
}

TEST(BlockCholesky, SolvesAsADenseFactorisationDoes) {
  expectSolvesAsDense<3>();
  expectSolvesAsDense<6>();
}

template <int kSize>
void expectSelectedInverse(const BlockMatrix<kSize>& matrix, const BlockKernels& kernels) {
  BlockCholesky<kSize> cholesky(matrix, kernels);
  ASSERT_TRUE(cholesky.factorize(matrix, 0));
  const Eigen::MatrixXd inverse = dense(matrix).inverse();
  const auto selected = selectedInverse(cholesky);
  const SymbolicCholesky& symbolic = cholesky.symbolic();
  const auto size = static_cast<int>(matrix.diagonal.size());
  std::vector<int> row_at(size);
  for (int row = 0; row < size; ++row) row_at[symbolic.place(row)] = row;
  for (int column = 0; column < size; ++column)
    for (int entry = symbolic.columnBegin(column); entry < symbolic.columnEnd(column); ++entry) {
      const Eigen::MatrixXd expected = inverse.block<kSize, kSize>(
          kSize * row_at[symbolic.rows()[entry]], kSize * row_at[column]);
      ASSERT_LT((selected[entry] - expected).norm(), 1e-12) << row_at[column];
    }
}

template <int kSize>
void expectSelectedInverses() {
  for (const auto& [name, matrix] : matrices<kSize>())
    for (const BlockKernels* kernels : availableBlockKernels()) {
      SCOPED_TRACE(name + " " + kernels->instruction_set);
      expectSelectedInverse(matrix, *kernels);
    }
}

TEST(BlockCholesky, SelectedInverseIsThatOfTheDenseMatrix) {
  expectSelectedInverses<3>();
  expectSelectedInverses<6>();
}

TEST(BlockCholesky, FactorisesAnewWhateverWasBefore) {
  Random random(5);
  const BlockMatrix<6> matrix = randomMatrix<6>(random, 100, 400);
  BlockMatrix<6> indefinite = matrix;
  indefinite.diagonal[50] *= -1.0;
  BlockCholesky<6> cholesky(matrix), fresh(matrix);
  EXPECT_FALSE(cholesky.factorize(indefinite, 0));
  ASSERT_TRUE(cholesky.factorize(matrix, 0));
  ASSERT_TRUE(fresh.factorize(matrix, 0));
  for (size_t entry = 0; entry < fresh.symbolic().rows().size(); ++entry)
    ASSERT_TRUE(fresh.blocks()[entry] == cholesky.blocks()[entry]);
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
  EXPECT_EQ(SymbolicCholesky(100, chain(100), 16).rows().size(), 199u);
}

TEST(SymbolicCholesky, HubIsEliminatedLast) {
  EXPECT_EQ(SymbolicCholesky(50, hub(50), 16).rows().size(), 99u);
}

TEST(SymbolicCholesky, PanelsHaveCommonRows) {
  const SymbolicCholesky symbolic(343, lattice(7), 16);
  int column = 0, wide = 0;
  for (int panel = 0; panel < symbolic.panels(); ++panel) {
    ASSERT_EQ(symbolic.panelBegin(panel), column);
    ASSERT_LE(symbolic.panelWidth(panel), 16);
    wide += symbolic.panelWidth(panel) == 16;
    for (int i = 0; i < symbolic.panelWidth(panel); ++i, ++column)
      ASSERT_TRUE(std::equal(symbolic.panelRows(panel) + i,
                             symbolic.panelRows(panel) + symbolic.panelHeight(panel),
                             symbolic.rows().begin() + symbolic.columnBegin(column),
                             symbolic.rows().begin() + symbolic.columnEnd(column)));
  }
  EXPECT_EQ(column, symbolic.size());
  EXPECT_GT(wide, 0) << "the lattice is cut by planes";
}

/** Products of blocks, by elimination in a dense matrix. */
double products(const std::vector<int>& place, const std::vector<BlockPair>& pairs) {
  const auto size = static_cast<int>(place.size());
  std::vector<std::vector<char>> rows(size, std::vector<char>(size, 0));
  for (const BlockPair pair : pairs)
    rows[std::min(place[pair.row], place[pair.column])]
        [std::max(place[pair.row], place[pair.column])] = 1;
  double sum = 0;
  for (int column = 0; column < size; ++column) {
    std::vector<int> below;
    for (int row = column + 1; row < size; ++row)
      if (rows[column][row]) below.push_back(row);
    for (size_t i = 0; i < below.size(); ++i)
      for (size_t j = i + 1; j < below.size(); ++j) rows[below[i]][below[j]] = 1;
    sum += 0.5 * static_cast<double>((below.size() + 1) * (below.size() + 2));
  }
  return sum;
}

TEST(SymbolicCholesky, DissectsWhereThatSavesWork) {
  constexpr int kSide = 18, kSize = kSide * kSide * kSide;
  const std::vector<BlockPair> pairs = lattice(kSide);
  const double by_degree = products(minimumDegreeOrder(kSize, pairs), pairs);
  const double dissected = products(nestedDissectionOrder(kSize, pairs), pairs);
  EXPECT_LT(dissected, by_degree);
  EXPECT_EQ(SymbolicCholesky(kSize, pairs, 16).products(), dissected);
}

TEST(EliminationOrder, HasEachPlaceOnceAndIsTheSameEachTime) {
  Random random(6);
  for (const auto& order : {minimumDegreeOrder, nestedDissectionOrder}) {
    EXPECT_TRUE(order(0, {}).empty());
    for (const int size : {1, 2, 500}) {
      const std::vector<BlockPair> pairs = randomPairs(random, size, size - 1);  // not connected
      std::vector<int> place = order(size, pairs);
      EXPECT_EQ(place, order(size, pairs));
      std::sort(place.begin(), place.end());
      for (int i = 0; i < size; ++i) EXPECT_EQ(place[i], i);
    }
  }
}

}  // namespace
}  // namespace lamp
