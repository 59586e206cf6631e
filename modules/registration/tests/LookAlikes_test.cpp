// A robot that comes back with an uncertain guess to a place that looks alike every few metres.
#include "lamp/registration/LookAlikes.h"

#include <gtest/gtest.h>

#include "../../scans/tests/TestCorridors.h"
#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;

/** Scans of a row of pillars, 1 m apart. */
class RowOfPillars : public testing::Test {
 protected:
  RowOfPillars() { registered(CLASS_ID(Stage)); }

  PreparedScanPtr scanAt(double x_m, unsigned seed) const {
    return prepareScan(scanOf(corridor_, {16, 900, 15, 0.01}, x_m, seed), 10, false);
  }
  LoopClosureAttempt closed(double guess_error_m, double sigma_m,
                            const AmbiguityOptions& options = {}) const {
    const LoopClosureComputation computation(
        {makeDefault<InitialAligner>("OdometryGuess")}, makeDefault<Refiner>("Gicp"),
        {makeDefault<Verifier>("GuessDeviation"), makeDefault<Verifier>("OverlapResidual"),
         makeDefault<Verifier>("FreeSpaceConsistency")},
        options);
    const double x = kSource_m - kTarget_m + guess_error_m;
    Vector6d variances = Vector6d::Constant(1e-4);
    variances[0] = sigma_m * sigma_m;
    return computation.compute(*scanAt(kSource_m, 2), *scanAt(kTarget_m, 1),
                               {planarPose(x, 0, 0), Matrix6d(variances.asDiagonal())});
  }

  static constexpr double kTarget_m = 50.2, kSource_m = 51.2;
  PillaredCorridor corridor_;
};

TEST_F(RowOfPillars, IsAmbiguousIfTheGuessAllowsTheNextPillar) {
  AmbiguityOptions none;
  none.look_alikes.look_alike_starts = 0;
  const LoopClosureAttempt wrong = closed(2.5, 1.5, none);
  ASSERT_TRUE(wrong.accepted) << "else the pillars do not look alike";
  EXPECT_NEAR(wrong.result.target_T_source.translation().x(), 1 + 3, 0.1);

  for (const double error_m : {2.5, -2.5, 0.3}) {
    const LoopClosureAttempt attempt = closed(error_m, 1.5);
    EXPECT_FALSE(attempt.accepted) << error_m;
    EXPECT_EQ(attempt.reason, "ambiguous") << error_m;
  }
}

TEST_F(RowOfPillars, IsNotAmbiguousIfTheGuessIsSure) {
  const LoopClosureAttempt attempt = closed(0.2, 0.1);
  EXPECT_TRUE(attempt.accepted) << attempt.stage << ": " << attempt.reason;
  EXPECT_NEAR(attempt.result.target_T_source.translation().x(), 1, 0.05);
}

TEST_F(RowOfPillars, IsNotAmbiguousWhereBothScansShowItsEnd) {
  corridor_.end_m = 60;
  const LoopClosureAttempt attempt = closed(0.3, 1.5);
  EXPECT_TRUE(attempt.accepted) << attempt.stage << ": " << attempt.reason;
  EXPECT_NEAR(attempt.result.target_T_source.translation().x(), 1, 0.05);
}

class LookAlikeStarts : public testing::Test {
 protected:
  std::vector<Pose3> starts(double sigma_x_m, double sigma_y_m, int most = 16) const {
    RegistrationResult result;
    result.target_T_source = planarPose(0.4, 0, 0.3);
    result.information = information_;
    Vector6d variances = Vector6d::Constant(1e-4);
    variances[0] = sigma_x_m * sigma_x_m;
    variances[1] = sigma_y_m * sigma_y_m;
    // The covariance is in the tangent space at the guess: its axes are the source's.
    const Guess guess{planarPose(0, 0, M_PI / 2), Matrix6d(variances.asDiagonal())};
    LookAlikeOptions options;
    options.look_alike_starts = most;
    return lookAlikeStarts(result, guess, *nothing_, *nothing_, options);
  }

  const PreparedScanPtr nothing_ = prepareScan({}, 3, false);
  Matrix6d information_ = Matrix6d::Identity();
};

TEST_F(LookAlikeStarts, AreNoneIfTheGuessIsSure) {
  EXPECT_TRUE(starts(0.2, 0.2).empty());
  EXPECT_TRUE(starts(5, 5, 0).empty());
  EXPECT_TRUE(lookAlikeStarts({}, {}, *nothing_, *nothing_, {}).empty())
      << "nothing is known of how wrong it is";
}

TEST_F(LookAlikeStarts, LieWhereTheGuessAllows) {
  const std::vector<Pose3> poses = starts(2, 0.01);
  EXPECT_GE(poses.size(), 6u);
  for (const Pose3& pose : poses) {
    EXPECT_LT(std::abs(pose.translation().x()), 2) << "the guess is sure about that";
    EXPECT_LT(std::abs(pose.translation().y()), 2 * 2 * 3.1 + 1.5);
    EXPECT_EQ(pose.translation().z(), 0);
    EXPECT_NEAR(yawOf(pose), 0.3, 1e-9) << "turned as the registration found it";
  }
}

TEST_F(LookAlikeStarts, DoNotLieWhereTheScansObserveNothing) {
  information_.topLeftCorner<2, 2>().setZero();
  EXPECT_TRUE(starts(5, 5).empty());
}

TEST_F(LookAlikeStarts, AreBounded) {
  EXPECT_EQ(starts(100, 100, 9).size(), 9u);
}

}  // namespace
}  // namespace lamp
