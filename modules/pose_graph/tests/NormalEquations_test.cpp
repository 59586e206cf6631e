#include "solver/NormalEquations.h"

#include <gtest/gtest.h>

#include "TestGraphs.h"

namespace lamp {
namespace {

template <class Space>
class NormalEquationsTest : public testing::Test {
 protected:
  NormalEquationsTest() {
    WorldOptions options;
    options.planar = Space::kDof == 3;
    options.nodes = 40;
    options.loops = 10;
    world = makeWorld(options);
    terms = poseTerms<Space>(world.graph);
    for (const Node& node : world.graph.nodes())
      poses.push_back(Space::fromPose3(node.world_T_base));
    unknowns.row.assign(poses.size(), -1);  // the first node is held
    for (size_t i = 1; i < poses.size(); ++i) unknowns.row[i] = unknowns.size++;
    unknowns.first_landmark_row = unknowns.size;
  }

  World world;
  std::vector<PoseTerm<Space>> terms;
  std::vector<typename Space::Pose> poses;
  Unknowns unknowns;
};
using Spaces = testing::Types<Se2, Se3>;
TYPED_TEST_SUITE(NormalEquationsTest, Spaces);

TYPED_TEST(NormalEquationsTest, GradientMatchesFiniteDifferencesOfTheCost) {
  using Space = TypeParam;
  constexpr int kDof = Space::kDof;
  this->terms[3].weight = 0.25;
  NormalEquations<Space> equations(this->terms, this->unknowns);
  const double cost = equations.linearize(this->poses);
  EXPECT_NEAR(equations.cost(this->poses), cost, 1e-9 * cost);
  constexpr double kStep = 1e-6;
  for (size_t node = 1; node < this->poses.size(); ++node)
    for (int axis = 0; axis < kDof; ++axis) {
      auto moved = this->poses;
      const typename Space::Tangent d = kStep * Space::Tangent::Unit(axis);
      moved[node] = Space::plus(this->poses[node], d);
      const double above = equations.cost(moved);
      moved[node] = Space::plus(this->poses[node], -d);
      const double numeric = (above - equations.cost(moved)) / (2 * kStep);
      const double gradient = equations.gradient()[kDof * this->unknowns.row[node] + axis];
      EXPECT_NEAR(gradient, numeric, 1e-4 * (1 + equations.gradient().cwiseAbs().maxCoeff()));
    }
}

/** H is what the terms' Jacobians make of it, whichever end of a pair comes first. */
TYPED_TEST(NormalEquationsTest, MatrixIsTheSumOfSquaredJacobians) {
  using Space = TypeParam;
  constexpr int kDof = Space::kDof;
  NormalEquations<Space> equations(this->terms, this->unknowns);
  equations.linearize(this->poses);
  Eigen::MatrixXd expected =
      Eigen::MatrixXd::Zero(kDof * this->unknowns.size, kDof * this->unknowns.size);
  for (const auto& term : this->terms) {
    typename Space::Jacobian d_from = Space::Jacobian::Zero(), d_to;
    term.error(this->poses[term.from], this->poses[term.to], &d_from, &d_to);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(kDof, kDof * this->unknowns.size);
    if (!term.isUnary() && this->unknowns.row[term.from] >= 0)
      J.middleCols(kDof * this->unknowns.row[term.from], kDof) = d_from;
    if (this->unknowns.row[term.to] >= 0)
      J.middleCols(kDof * this->unknowns.row[term.to], kDof) = d_to;
    expected += J.transpose() * term.information * J;
  }
  const auto& matrix = equations.matrix();
  for (int i = 0; i < this->unknowns.size; ++i)
    EXPECT_TRUE(matrix.diagonal[i].isApprox(expected.block(kDof * i, kDof * i, kDof, kDof), 1e-9));
  for (size_t i = 0; i < matrix.pairs.size(); ++i)
    EXPECT_TRUE(matrix.off_diagonal[i].isApprox(
        expected.block(kDof * matrix.pairs[i].row, kDof * matrix.pairs[i].column, kDof, kDof),
        1e-9));
}

TYPED_TEST(NormalEquationsTest, TermsWithoutWeightLeaveTheStructure) {
  using Space = TypeParam;
  const auto pairs = [&] {
    return NormalEquations<Space>(this->terms, this->unknowns).matrix().pairs.size();
  };
  const size_t before = pairs();
  for (auto& term : this->terms)
    if (!term.isUnary() && this->world.graph.nodes()[term.from].id.robot !=
                               this->world.graph.nodes()[term.to].id.robot)
      term.weight = 0;
  EXPECT_LT(pairs(), before);
}

}  // namespace
}  // namespace lamp
