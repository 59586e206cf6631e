#include <gtest/gtest.h>

#include "TestScans.h"
#include "lamp/registration/GuessAligners.h"

namespace lamp {
namespace {

using namespace test;

Pose3 startOf(const InitialAligner& aligner, const Pose3& guess) {
  const auto nothing = prepareScan({}, 10, false);
  const AlignmentResult result = aligner.align(*nothing, *nothing, {guess, std::nullopt});
  EXPECT_EQ(result.hypotheses.size(), 1u);
  return result.hypotheses.at(0).target_T_source;
}

TEST(GuessAligners, EachTakesItsPartOfTheGuess) {
  const Pose3 guess = expSE3(tangent(4, -3, 2, 0.3, -0.2, 1.0));
  EXPECT_EQ(startOf(OdometryGuess{}, guess).matrix(), guess.matrix());
  EXPECT_EQ(startOf(IdentityGuess{}, guess).matrix(), Pose3::Identity().matrix());
  const Pose3 rotation = startOf(OdometryRotationGuess{}, guess);
  EXPECT_EQ(rotation.linear(), guess.linear());
  EXPECT_EQ(rotation.translation(), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace lamp
