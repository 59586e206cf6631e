#include "lamp/registration/LoopClosureComputation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestScans.h"

namespace lamp {

/** Gives the hypotheses that it was told to. */
class ScriptedAligner : public InitialAligner {
  DEFINE_MRPT_OBJECT(ScriptedAligner, lamp)
 public:
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan&, const PreparedScan&, const Guess&) const override {
    return answer;
  }
  AlignmentResult answer;
};

/** Returns each hypothesis as it is; one at x >= 10 m does not converge. */
class ScriptedRefiner : public Refiner {
  DEFINE_MRPT_OBJECT(ScriptedRefiner, lamp)
 public:
  void visit(OptionVisitor&) override {}
  RegistrationResult refine(const PreparedScan&, const PreparedScan&,
                            const Hypothesis& hypothesis) const override {
    ++calls;
    RegistrationResult result;
    result.target_T_source = hypothesis.target_T_source;
    result.information = information;
    result.converged = hypothesis.target_T_source.translation().x() < 10;
    return result;
  }
  Matrix6d information = Matrix6d::Identity();
  mutable int calls = 0;
};

/** Accepts results at x >= `limit`. */
class ScriptedVerifier : public Verifier {
  DEFINE_MRPT_OBJECT(ScriptedVerifier, lamp)
 public:
  void visit(OptionVisitor&) override {}
  Verification verify(const RegistrationResult& result, const PreparedScan&, const PreparedScan&,
                      const Guess&) const override {
    ++calls;
    const double x = result.target_T_source.translation().x();
    return {x >= limit ? "" : "too near", {{getLoggerName() + "_x", x, limit}}};
  }
  double limit = 0;
  mutable int calls = 0;
};

}  // namespace lamp

IMPLEMENTS_MRPT_OBJECT(ScriptedAligner, lamp::InitialAligner, lamp)
IMPLEMENTS_MRPT_OBJECT(ScriptedRefiner, lamp::Refiner, lamp)
IMPLEMENTS_MRPT_OBJECT(ScriptedVerifier, lamp::Verifier, lamp)

namespace lamp {
namespace {

using namespace test;
using testing::IsEmpty;

Hypothesis at(double x) {
  Hypothesis hypothesis;
  hypothesis.target_T_source = planarPose(x, 0, 0);
  return hypothesis;
}

class LoopClosureComputationTest : public testing::Test {
 protected:
  LoopClosureComputationTest() {
    aligner->setLoggerName("Aligner");
    refiner->setLoggerName("Refiner");
    first->setLoggerName("First");
    second->setLoggerName("Second@strict");
  }

  void hypothesesAt(const std::vector<double>& xs) const {
    for (const double x : xs) aligner->answer.hypotheses.push_back(at(x));
  }

  LoopClosureAttempt compute() const {
    const auto scan = prepareScan({}, 3, false);
    return LoopClosureComputation({aligner}, refiner, {first, second}, {})
        .compute(*scan, *scan, {});
  }

  const std::shared_ptr<ScriptedAligner> aligner = std::make_shared<ScriptedAligner>();
  const std::shared_ptr<ScriptedRefiner> refiner = std::make_shared<ScriptedRefiner>();
  const std::shared_ptr<ScriptedVerifier> first = std::make_shared<ScriptedVerifier>();
  const std::shared_ptr<ScriptedVerifier> second = std::make_shared<ScriptedVerifier>();
};

TEST_F(LoopClosureComputationTest, AcceptsWhatAllVerifiersAccept) {
  hypothesesAt({3});
  const LoopClosureAttempt attempt = compute();
  EXPECT_TRUE(attempt.accepted);
  EXPECT_EQ(attempt.stage, "verified");
  EXPECT_EQ(attempt.reason, "");
  EXPECT_DOUBLE_EQ(attempt.result.target_T_source.translation().x(), 3);
  ASSERT_EQ(attempt.scores.size(), 2u);
  EXPECT_EQ(attempt.scores[0].name, "First_x");
  EXPECT_EQ(attempt.scores[1].name, "Second@strict_x");
}

TEST_F(LoopClosureComputationTest, TheAlignerMayRefuse) {
  aligner->answer.refusal = "too few matches";
  const LoopClosureAttempt attempt = compute();
  EXPECT_FALSE(attempt.accepted);
  EXPECT_EQ(attempt.stage, "Aligner");
  EXPECT_EQ(attempt.reason, "too few matches");
  EXPECT_THAT(attempt.scores, IsEmpty());
  EXPECT_EQ(refiner->calls, 0);
  EXPECT_EQ(first->calls, 0);
}

TEST_F(LoopClosureComputationTest, TheRefinerMayNotConverge) {
  hypothesesAt({12});
  const LoopClosureAttempt attempt = compute();
  EXPECT_FALSE(attempt.accepted);
  EXPECT_EQ(attempt.stage, "Refiner");
  EXPECT_EQ(attempt.reason, "did not converge");
  EXPECT_EQ(first->calls, 0) << "there is nothing to verify";
}

TEST_F(LoopClosureComputationTest, TheFirstVerifierThatRefusesIsNamed) {
  hypothesesAt({3});
  second->limit = 5;
  const LoopClosureAttempt attempt = compute();
  EXPECT_FALSE(attempt.accepted);
  EXPECT_EQ(attempt.stage, "Second@strict");
  EXPECT_EQ(attempt.reason, "too near");
  EXPECT_EQ(attempt.scores.size(), 2u) << "what the verifiers before it measured stays";

  first->limit = 4;
  second->calls = 0;
  EXPECT_EQ(compute().stage, "First");
  EXPECT_EQ(second->calls, 0);
}

TEST_F(LoopClosureComputationTest, FollowsAllHypothesesAndTakesTheFirstThatIsAccepted) {
  hypothesesAt({12, 1, 6, 6.5});
  first->limit = 5;
  const LoopClosureAttempt attempt = compute();
  EXPECT_TRUE(attempt.accepted);
  EXPECT_DOUBLE_EQ(attempt.result.target_T_source.translation().x(), 6);
  EXPECT_EQ(refiner->calls, 4);
  EXPECT_EQ(attempt.scores.size(), 2u) << "scores of the accepted hypothesis only";
}

TEST_F(LoopClosureComputationTest, TwoDifferentAnswersAreNone) {
  hypothesesAt({3, 5});
  const LoopClosureAttempt attempt = compute();
  EXPECT_FALSE(attempt.accepted);
  EXPECT_EQ(attempt.stage, "Aligner");
  EXPECT_EQ(attempt.reason, "ambiguous");
}

TEST_F(LoopClosureComputationTest, OfTwoDifferentAnswersTheOneWithMuchMoreOverlapIsTaken) {
  std::vector<Eigen::Vector3f> room;
  for (float a = 0; a < 6; a += 0.3f)
    for (float b = 0; b < 3; b += 0.3f) {
      room.emplace_back(3, a - 3, b - 1);
      room.emplace_back(-3, a - 3, b - 1);
      room.emplace_back(a - 3, 3, b - 1);
    }
  const auto scan = prepareScan(room, 10, false);
  for (const std::vector<double>& order : {std::vector<double>{3, 0}, {0, 3}}) {
    aligner->answer.hypotheses.clear();
    hypothesesAt(order);
    const LoopClosureAttempt attempt =
        LoopClosureComputation({aligner}, refiner, {}, {}).compute(*scan, *scan, {});
    EXPECT_TRUE(attempt.accepted);
    EXPECT_DOUBLE_EQ(attempt.result.target_T_source.translation().x(), 0);
    ASSERT_EQ(attempt.alignments.size(), 1u);
    EXPECT_EQ(attempt.alignments[0].aligner, "Aligner");
    EXPECT_EQ(attempt.alignments[0].alignment.hypotheses.size(), 2u);
  }
}

TEST_F(LoopClosureComputationTest, AnswersThatDifferWhereNothingIsKnownAreOne) {
  hypothesesAt({3, 5});
  refiner->information.diagonal()[0] = 0;
  EXPECT_TRUE(compute().accepted);
}

TEST_F(LoopClosureComputationTest, TheRefusalOfTheHypothesisThatCameFarthestIsTold) {
  hypothesesAt({12, 3, 1});
  first->limit = 2;
  second->limit = 4;
  const LoopClosureAttempt attempt = compute();
  EXPECT_EQ(attempt.stage, "Second@strict");
  EXPECT_DOUBLE_EQ(attempt.result.target_T_source.translation().x(), 3);
}

TEST_F(LoopClosureComputationTest, TheNextAlignerIsAskedIfTheFirstOneFails) {
  const auto other = std::make_shared<ScriptedAligner>();
  other->answer.hypotheses = {at(7)};
  hypothesesAt({3});
  const auto scan = prepareScan({}, 3, false);
  const LoopClosureComputation both({aligner, other}, refiner, {first, second}, {});
  EXPECT_DOUBLE_EQ(both.compute(*scan, *scan, {}).result.target_T_source.translation().x(), 3);
  first->limit = 5;
  const LoopClosureAttempt attempt = both.compute(*scan, *scan, {});
  EXPECT_TRUE(attempt.accepted);
  EXPECT_DOUBLE_EQ(attempt.result.target_T_source.translation().x(), 7);
}

TEST_F(LoopClosureComputationTest, WithoutVerifiersConvergenceIsEnough) {
  hypothesesAt({3});
  const auto scan = prepareScan({}, 3, false);
  EXPECT_TRUE(
      LoopClosureComputation({aligner}, refiner, {}, {}).compute(*scan, *scan, {}).accepted);
}

TEST_F(LoopClosureComputationTest, RealStagesCloseALoopAndRefuseAWrongPlace) {
  registered(CLASS_ID(Stage));
  const LoopClosureComputation computation(
      {makeDefault<InitialAligner>("OdometryGuess")}, makeDefault<Refiner>("Gicp"),
      {makeDefault<Verifier>("OverlapResidual"), makeDefault<Verifier>("GuessDeviation")}, {});
  const RoomPair room(expSE3(tangent(0.8, -0.5, 0.1, 0.02, 0.01, 0.3)), false);
  const Guess guess{room.truth * planarPose(0.4, 0.3, 0.1), 0.1 * Matrix6d::Identity()};
  const LoopClosureAttempt right = computation.compute(*room.source, *room.target, guess);
  ASSERT_TRUE(right.accepted) << right.stage << ": " << right.reason;
  EXPECT_LT((room.truth.inverse() * right.result.target_T_source).translation().norm(), 0.03);

  // The corner of another hall: nothing of the room's far side is there.
  Points corner;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 15; ++j) {
      const float a = 0.1f * static_cast<float>(i), b = 0.2f * static_cast<float>(j);
      corner.insert(corner.end(), {{a, 0.7f * a, b}, {-0.4f * a, a, b}});
    }
  const auto wrong = computation.compute(*room.source, *prepareScan(corner, 10, false), guess);
  EXPECT_FALSE(wrong.accepted);
  EXPECT_FALSE(wrong.reason.empty());
}

}  // namespace
}  // namespace lamp
