// What every initial aligner, refiner and verifier must hold to, whoever wrote it: the suites run
// over all that is registered.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "TestScans.h"

namespace lamp {
namespace {

using namespace test;

const Pose3 kMotion3d = expSE3(tangent(0.4, -0.3, 0.2, 0.05, -0.04, 0.15));
const Pose3 kMotionPlanar = planarPose(0.4, -0.2, 10 * kDegree);

Guess guessNear(const Pose3& truth) {
  Guess guess{truth * expSE3(tangent(0.1, -0.1, 0, 0, 0, 0.02)), 0.25 * Matrix6d::Identity()};
  return guess;
}

/** Finite, symmetric, and no direction of negative information but for rounding. */
bool isInformation(const Matrix6d& m) {
  if (!m.allFinite() || m != m.transpose()) return false;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(m);
  return eigen.eigenvalues()[0] >= -1e-9 * std::max(1.0, eigen.eigenvalues()[5]);
}

/** Calls `check(scan, other)` with each hopeless cloud on either side, in 3D and in the plane. */
template <class Check>
void forHopelessPairs(const Check& check) {
  for (const bool planar : {false, true}) {
    const RoomPair room(planar ? kMotionPlanar : kMotion3d, planar);
    for (const NamedPoints& hopeless : hopelessClouds()) {
      SCOPED_TRACE(hopeless.name + (planar ? ", planar" : ""));
      const auto scan = prepareScan(hopeless.points, 10, planar);
      check(*scan, *room.target);
      check(*room.source, *scan);
    }
  }
}

TEST(Registered, AllKindsHaveImplementations) {
  EXPECT_EQ(registered(CLASS_ID(InitialAligner)).size(), 6u);
  EXPECT_EQ(registered(CLASS_ID(Refiner)).size(), 2u);
  EXPECT_EQ(registered(CLASS_ID(Verifier)).size(), 5u);
}

class AnyInitialAligner : public testing::TestWithParam<std::string> {
 protected:
  const std::shared_ptr<InitialAligner> aligner = makeDefault<InitialAligner>(GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, AnyInitialAligner,
                         testing::ValuesIn(registered(CLASS_ID(InitialAligner))), testName);

TEST_P(AnyInitialAligner, GivesHypothesesOrAReason) {
  const auto check = [&](const PreparedScan& source, const PreparedScan& target) {
    for (const Guess& guess : {Guess{}, guessNear(kMotion3d)}) {
      const AlignmentResult result = aligner->align(source, target, guess);
      EXPECT_EQ(result.hypotheses.empty(), !result.refusal.empty()) << result.refusal;
      for (const Hypothesis& hypothesis : result.hypotheses) {
        const Eigen::Matrix3d R = hypothesis.target_T_source.linear();
        EXPECT_TRUE(isFinite(hypothesis.target_T_source));
        EXPECT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-9);
      }
    }
  };
  forHopelessPairs(check);
  const RoomPair room(kMotion3d, false);
  check(*room.source, *room.target);
}

TEST_P(AnyInitialAligner, StartsNearEnoughForSmallMotions) {
  for (const bool planar : {false, true}) {
    const RoomPair room(planar ? kMotionPlanar : kMotion3d, planar);
    auto result = aligner->align(*room.source, *room.target, guessNear(room.truth));
    if (result.refusal == "the graph has a guess")
      result = aligner->align(*room.source, *room.target, Guess{});
    if (result.refusal ==
        (planar ? "planar scans have no descriptors" : "not both scans are planar"))
      continue;
    ASSERT_FALSE(result.hypotheses.empty()) << result.refusal;
    const Pose3 error = room.truth.inverse() * result.hypotheses.front().target_T_source;
    EXPECT_LT(error.translation().norm(), 1.0);
    EXPECT_LT(rotationAngle(error), 20 * kDegree);
  }
}

TEST_P(AnyInitialAligner, SaysTheSameTwice) {
  const RoomPair room(kMotion3d, false);
  const auto once = aligner->align(*room.source, *room.target, guessNear(room.truth));
  const auto again = aligner->align(*room.source, *room.target, guessNear(room.truth));
  ASSERT_EQ(once.hypotheses.size(), again.hypotheses.size());
  for (size_t i = 0; i < once.hypotheses.size(); ++i)
    EXPECT_EQ(once.hypotheses[i].target_T_source.matrix(),
              again.hypotheses[i].target_T_source.matrix());
}

class AnyRefiner : public testing::TestWithParam<std::string> {
 protected:
  const std::shared_ptr<Refiner> refiner = makeDefault<Refiner>(GetParam());
};
INSTANTIATE_TEST_SUITE_P(All, AnyRefiner, testing::ValuesIn(registered(CLASS_ID(Refiner))),
                         testName);

TEST_P(AnyRefiner, FindsAKnownMotion) {
  const RoomPair room(kMotion3d, false);
  const RegistrationResult result = refiner->refine(*room.source, *room.target, {});
  ASSERT_TRUE(result.converged);
  EXPECT_GT(result.iterations, 0);
  const Pose3 error = room.truth.inverse() * result.target_T_source;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_LT(rotationAngle(error), 0.5 * kDegree);
}

TEST_P(AnyRefiner, FindsAKnownMotionInThePlaneAndStaysThere) {
  const RoomPair room(kMotionPlanar, true);
  const RegistrationResult result = refiner->refine(*room.source, *room.target, {});
  ASSERT_TRUE(result.converged);
  const Pose3 error = room.truth.inverse() * result.target_T_source;
  EXPECT_LT(error.translation().norm(), 0.03);
  EXPECT_LT(rotationAngle(error), 0.5 * kDegree);
  EXPECT_EQ(result.target_T_source.translation().z(), 0.0);
  EXPECT_LT((result.target_T_source.matrix() - projectToPlane(result.target_T_source).matrix())
                .cwiseAbs()
                .maxCoeff(),
            1e-12);
}

TEST_P(AnyRefiner, CoversItsErrorWithItsInformation) {
  for (const bool planar : {false, true}) {
    const RoomPair room(planar ? kMotionPlanar : kMotion3d, planar);
    const RegistrationResult result = refiner->refine(*room.source, *room.target, {});
    const Vector6d error = logSE3(result.target_T_source.inverse() * room.truth);
    EXPECT_LT(error.dot(result.information * error), 22.5) << "99.9 % of chi-square 6";
    EXPECT_GT(result.information(0, 0), 1 / (0.3 * 0.3)) << "a room is observed well";
    EXPECT_GT(result.information(5, 5), 1 / std::pow(3 * kDegree, 2));
    EXPECT_TRUE(result.unobserved.empty());
  }
}

TEST_P(AnyRefiner, StaysFiniteOnHopelessPairs) {
  forHopelessPairs([&](const PreparedScan& source, const PreparedScan& target) {
    const RegistrationResult result = refiner->refine(source, target, {});
    EXPECT_TRUE(isFinite(result.target_T_source));
    EXPECT_TRUE(isInformation(result.information));
    EXPECT_FALSE(result.converged && std::min(source.size(), target.size()) < 2);
  });
}

TEST_P(AnyRefiner, MakesNoLoopOfHopelessPairs) {
  const LoopClosureComputation computation({makeDefault<InitialAligner>("IdentityGuess")}, refiner,
                                           {makeDefault<Verifier>("OverlapResidual")}, {});
  forHopelessPairs([&](const PreparedScan& source, const PreparedScan& target) {
    const LoopClosureAttempt attempt = computation.compute(source, target, {});
    EXPECT_FALSE(attempt.accepted);
    EXPECT_FALSE(attempt.reason.empty());
  });
}

TEST_P(AnyRefiner, SaysTheSameTwice) {
  const RoomPair room(kMotion3d, false);
  const RegistrationResult once = refiner->refine(*room.source, *room.target, {});
  const RegistrationResult again = refiner->refine(*room.source, *room.target, {});
  EXPECT_EQ(once.target_T_source.matrix(), again.target_T_source.matrix());
  EXPECT_EQ(once.information, again.information);
}

class AnyVerifier : public testing::TestWithParam<std::string> {
 protected:
  const std::shared_ptr<Verifier> verifier = makeDefault<Verifier>(GetParam());

  static RegistrationResult at(const Pose3& target_T_source) {
    RegistrationResult result;
    result.target_T_source = target_T_source;
    result.start = target_T_source;
    result.information = 1e3 * Matrix6d::Identity();
    result.converged = true;
    return result;
  }
};
INSTANTIATE_TEST_SUITE_P(All, AnyVerifier, testing::ValuesIn(registered(CLASS_ID(Verifier))),
                         testName);

TEST_P(AnyVerifier, AcceptsTheTruth) {
  for (const bool planar : {false, true}) {
    const RoomPair room(planar ? kMotionPlanar : kMotion3d, planar);
    const Verification verification =
        verifier->verify(at(room.truth), *room.source, *room.target, guessNear(room.truth));
    EXPECT_TRUE(verification.accepted()) << verification.refusal;
    EXPECT_FALSE(verification.scores.empty());
  }
}

TEST_P(AnyVerifier, RefusesWhatIsWrongByEveryMeasure) {
  for (const bool planar : {false, true}) {
    const RoomPair room(planar ? kMotionPlanar : kMotion3d, planar);
    const Pose3 wrong = room.truth * planarPose(3, 2, 40 * kDegree);
    const Guess guess{room.truth, 0.01 * Matrix6d::Identity()};
    const Verification verification =
        verifier->verify(at(wrong), *room.source, *room.target, guess);
    EXPECT_FALSE(verification.accepted());
    EXPECT_FALSE(verification.scores.empty()) << "the ledger must show why";
  }
}

TEST_P(AnyVerifier, RefusesAPoseThatIsNoNumber) {
  const RoomPair room(kMotion3d, false);
  Pose3 broken = room.truth;
  broken.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(
      verifier->verify(at(broken), *room.source, *room.target, guessNear(room.truth)).accepted());
}

TEST_P(AnyVerifier, NamesItsFiniteScoresForHopelessPairs) {
  forHopelessPairs([&](const PreparedScan& source, const PreparedScan& target) {
    for (const Guess& guess : {Guess{}, guessNear(Pose3::Identity())})
      for (const Score& score :
           verifier->verify(at(Pose3::Identity()), source, target, guess).scores) {
        EXPECT_FALSE(score.name.empty());
        EXPECT_TRUE(std::isfinite(score.value)) << score.name;
        EXPECT_TRUE(!score.threshold || std::isfinite(*score.threshold)) << score.name;
      }
  });
}

TEST_P(AnyVerifier, SaysTheSameTwice) {
  const RoomPair room(kMotion3d, false);
  const Guess guess = guessNear(room.truth);
  const auto once = verifier->verify(at(room.truth), *room.source, *room.target, guess);
  const auto again = verifier->verify(at(room.truth), *room.source, *room.target, guess);
  EXPECT_EQ(once.refusal, again.refusal);
  ASSERT_EQ(once.scores.size(), again.scores.size());
  for (size_t i = 0; i < once.scores.size(); ++i) {
    EXPECT_EQ(once.scores[i].name, again.scores[i].name);
    EXPECT_EQ(once.scores[i].value, again.scores[i].value);
    EXPECT_EQ(once.scores[i].threshold, again.scores[i].threshold);
  }
}

}  // namespace
}  // namespace lamp
