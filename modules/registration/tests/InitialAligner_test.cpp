#include <gtest/gtest.h>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;

Pose3 startOf(const InitialAligner& aligner, const Pose3& guess) {
  const auto nothing = prepareScan({}, 10, false);
  const AlignmentResult result = aligner.align(*nothing, *nothing, {guess, std::nullopt});
  EXPECT_EQ(result.hypotheses.size(), 1u);
  return result.hypotheses.at(0).target_T_source;
}

TEST(InitialAligner, EachTakesItsPartOfTheGuess) {
  const Pose3 guess = expSE3(tangent(4, -3, 2, 0.3, -0.2, 1.0));
  EXPECT_EQ(startOf(Odometry{}, guess).matrix(), guess.matrix());
  EXPECT_EQ(startOf(Identity{}, guess).matrix(), Pose3::Identity().matrix());
  const Pose3 rotation = startOf(OdometryRotation{}, guess);
  EXPECT_EQ(rotation.linear(), guess.linear());
  EXPECT_EQ(rotation.translation(), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace lamp
