// Passages without any detail along them: what a registration may claim there.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "../../scans/tests/TestCorridors.h"
#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;

struct Passage {
  bool round;
  TestLidar lidar;
};

std::string passageName(const testing::TestParamInfo<Passage>& info) {
  const TestLidar& lidar = info.param.lidar;
  return std::string(info.param.round ? "round" : "rectangular") + "_" +
         std::to_string(lidar.rings) + "_rings_noise_" +
         std::to_string(std::lround(1000 * lidar.noise_m)) + "_mm";
}

class SmoothPassage : public testing::TestWithParam<Passage> {
 protected:
  PreparedScanPtr scanAt(double x_m, double end_m, unsigned seed) const {
    SmoothCorridor corridor;
    corridor.round = GetParam().round;
    corridor.end_m = end_m;
    return prepareScan(scanOf(corridor, GetParam().lidar, x_m, seed), 10, false);
  }
  static RegistrationResult refined(const PreparedScan& source, const PreparedScan& target) {
    return makeDefault<Refiner>("Gicp")->refine(source, target, Hypothesis{});
  }
  /** Standard deviation along the passage, metres; infinite if it is not observed. */
  static double sigmaAlong(const RegistrationResult& result) {
    constexpr double kNothing = 1e-9, kUnobservedPart = 0.5;
    const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(result.information);
    double variance = 0, unobserved = 0;
    for (int k = 0; k < 6; ++k) {
      const double part = eigen.eigenvectors()(0, k) * eigen.eigenvectors()(0, k);
      if (eigen.eigenvalues()[k] > kNothing * eigen.eigenvalues()[5])
        variance += part / eigen.eigenvalues()[k];
      else
        unobserved += part;
    }
    return unobserved > kUnobservedPart ? kEndless_m : std::sqrt(variance);
  }
  static constexpr double kEndless_m = std::numeric_limits<double>::infinity();
};
INSTANTIATE_TEST_SUITE_P(
    Lidars, SmoothPassage,
    testing::Values(Passage{false, {16, 900, 25, 0.01}}, Passage{false, {16, 900, 100, 0.03}},
                    Passage{false, {32, 1024, 100, 0.02}}, Passage{false, {64, 1024, 60, 0}},
                    Passage{false, {128, 1024, 100, 0.03}}, Passage{true, {16, 900, 25, 0.03}},
                    Passage{true, {32, 1024, 100, 0.01}}, Passage{true, {128, 1024, 100, 0.01}}),
    passageName);

TEST_P(SmoothPassage, IsNotObservedAlongItsAxis) {
  // Scans 7 m apart look the same, and nothing in them says otherwise.
  const auto target = scanAt(0, kEndless_m, 1), source = scanAt(7, kEndless_m, 2);
  const RegistrationResult result = refined(*source, *target);
  ASSERT_TRUE(result.converged);
  EXPECT_EQ(sigmaAlong(result), kEndless_m);
  EXPECT_GT(result.information(1, 1), 100) << "the walls hold it across";
  EXPECT_GT(result.information(5, 5), 100) << "and in its heading";
}

TEST_P(SmoothPassage, IsObservedAlongItsAxisWhereAWallClosesIt) {
  constexpr double kEnd_m = 15, kApart_m = 1.5;
  const auto target = scanAt(0, kEnd_m, 1), source = scanAt(kApart_m, kEnd_m, 2);
  const RegistrationResult result = refined(*source, *target);
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.target_T_source.translation().x(), kApart_m, 0.05);
  EXPECT_LT(sigmaAlong(result), 0.1);
}

TEST_P(SmoothPassage, SlidesToTheWallThatBothSee) {
  // The walls and the rings look the same at 0 and at 7 m; only the end does not.
  constexpr double kEnd_m = 17, kApart_m = 7;
  const auto target = scanAt(0, kEnd_m, 1), source = scanAt(kApart_m, kEnd_m, 2);
  const RegistrationResult result = refined(*source, *target);
  ASSERT_TRUE(result.converged);
  EXPECT_NEAR(result.target_T_source.translation().x(), kApart_m, 0.1);
  EXPECT_LT(sigmaAlong(result), 0.1);
}

TEST_P(SmoothPassage, AWallThatOneOfThemSeesHoldsNothing) {
  const double far_m = GetParam().lidar.max_range_m + 5;
  const auto target = scanAt(0, far_m, 1), source = scanAt(far_m - 15, far_m, 2);
  const RegistrationResult result = refined(*source, *target);
  ASSERT_TRUE(result.converged);
  EXPECT_EQ(sigmaAlong(result), kEndless_m);
}

}  // namespace
}  // namespace lamp
