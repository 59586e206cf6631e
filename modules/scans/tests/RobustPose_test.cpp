#include "lamp/scans/RobustPose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lamp/scans/ConsistencyGraph.h"

namespace lamp {
namespace {

using Eigen::Vector3d;

constexpr double kNoise_m = 0.05;

class Scene {
 public:
  explicit Scene(unsigned seed, bool upright) : random_(seed) {
    const Vector3d axis = upright ? Vector3d::UnitZ() : inBox(1).normalized();
    truth.linear() = Eigen::AngleAxisd(uniform(-M_PI, M_PI), axis).toRotationMatrix();
    truth.translation() = inBox(20);
  }

  /** In random order, as far as outliers go: the first ones are inliers. */
  std::vector<PointPair> pairs(int count, double outliers) {
    std::vector<PointPair> result;
    for (int i = 0; i < count; ++i) {
      const Vector3d source = inBox(10);
      const bool right = i < std::lround((1 - outliers) * count);
      result.push_back({source, right ? Vector3d(truth * source + inBox(kNoise_m / 2))
                                      : Vector3d(truth.translation() + inBox(15))});
    }
    std::shuffle(result.begin(), result.end(), random_);
    return result;
  }

  std::vector<PointPair> inliers(const std::vector<PointPair>& pairs) const {
    std::vector<PointPair> result;
    for (const PointPair& pair : pairs)
      if ((pair.target - truth * pair.source).norm() < kNoise_m) result.push_back(pair);
    return result;
  }

  Vector3d inBox(double half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Pose3 truth = Pose3::Identity();

 private:
  std::mt19937 random_;
};

double rotationError(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

/** The matches that keep their distances, as before a pose in the aligner. */
std::vector<PointPair> consistent(const std::vector<PointPair>& pairs) {
  ConsistencyGraph graph(pairs.size());
  for (size_t i = 0; i < pairs.size(); ++i)
    for (size_t j = i + 1; j < pairs.size(); ++j) {
      const double before = (pairs[i].source - pairs[j].source).norm();
      const double after = (pairs[i].target - pairs[j].target).norm();
      if (std::abs(before - after) <= 2 * kNoise_m) graph.connect(i, j);
    }
  std::vector<PointPair> result;
  for (const uint32_t i : maximumClique(graph, std::vector<bool>(pairs.size(), true)))
    result.push_back(pairs[i]);
  return result;
}

class Solvers : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(FreeAndUpright, Solvers, testing::Bool());

TEST_P(Solvers, LeastSquaresPoseIsExactWithoutNoise) {
  Scene scene(1, GetParam());
  std::vector<PointPair> pairs;
  for (int i = 0; i < 5; ++i) {
    const Vector3d p = scene.inBox(10);
    pairs.push_back({p, scene.truth * p});
  }
  EXPECT_LT((leastSquaresPose(pairs, GetParam()).matrix() - scene.truth.matrix()).norm(), 1e-9);
}

TEST_P(Solvers, LeastSquaresPoseHasTheLeastSquares) {
  Scene scene(2, GetParam());
  const auto pairs = scene.pairs(30, 0.3);
  const Pose3 best = leastSquaresPose(pairs, GetParam());
  const auto cost = [&](const Pose3& pose) {
    double sum = 0;
    for (const PointPair& pair : pairs) sum += (pair.target - pose * pair.source).squaredNorm();
    return sum;
  };
  for (int axis = 0; axis < 6; ++axis) {
    if (GetParam() && (axis == 3 || axis == 4)) continue;  // upright poses turn about z only
    for (const double step : {-1e-3, 1e-3})
      EXPECT_GT(cost(best * expSE3(step * Vector6d::Unit(axis))), cost(best)) << axis;
  }
}

TEST_P(Solvers, RotationWithOutliersIsThatOfTheInliers) {
  for (const double outliers : {0.0, 0.2, 0.5, 0.8})
    for (unsigned seed = 0; seed < 5; ++seed) {
      Scene scene(seed, GetParam());
      scene.truth.translation().setZero();
      const auto pairs = scene.pairs(400, outliers);
      EXPECT_LT(rotationError(robustRotation(pairs, kNoise_m, GetParam()), scene.truth.linear()),
                0.2 * M_PI / 180)
          << outliers << " " << seed;
    }
}

TEST_P(Solvers, PoseWithFewOutliersIsThatOfTheInliers) {
  for (const double outliers : {0.0, 0.2, 0.5})
    for (unsigned seed = 0; seed < 5; ++seed) {
      Scene scene(seed, GetParam());
      const auto pairs = scene.pairs(100, outliers);
      const auto pose = robustPose(pairs, kNoise_m, GetParam());
      ASSERT_TRUE(pose) << outliers << " " << seed;
      const Pose3 closed_form = leastSquaresPose(scene.inliers(pairs), GetParam());
      EXPECT_LT(logSE3(closed_form.inverse() * *pose).norm(), 0.02) << outliers << " " << seed;
    }
}

TEST_P(Solvers, PoseOfTheConsistentPairsIsThatOfTheInliers) {
  for (const double outliers : {0.5, 0.8, 0.9, 0.95})
    for (unsigned seed = 0; seed < 3; ++seed) {
      Scene scene(seed, GetParam());
      const auto pairs = scene.pairs(400, outliers);
      const auto pose = robustPose(consistent(pairs), kNoise_m, GetParam());
      ASSERT_TRUE(pose) << outliers << " " << seed;
      const Pose3 closed_form = leastSquaresPose(scene.inliers(pairs), GetParam());
      EXPECT_LT(logSE3(closed_form.inverse() * *pose).norm(), 0.05) << outliers << " " << seed;
    }
}

TEST(RobustPose, NoneOfTooFewPairsOrOfNoise) {
  Scene scene(3, false);
  EXPECT_FALSE(robustPose({}, kNoise_m, false));
  EXPECT_FALSE(robustPose(scene.pairs(2, 0), kNoise_m, false));
  EXPECT_TRUE(robustPose(scene.pairs(3, 0), kNoise_m, false));
  EXPECT_FALSE(robustPose(scene.pairs(6, 1), kNoise_m, false));
}

TEST(RobustPose, OfEqualPointsIsFinite) {
  const std::vector<PointPair> equal(5, {Vector3d(1, 2, 3), Vector3d(4, 5, 6)});
  const auto pose = robustPose(equal, kNoise_m, false);
  ASSERT_TRUE(pose);
  EXPECT_LT((*pose * Vector3d(1, 2, 3) - Vector3d(4, 5, 6)).norm(), 1e-9);
}

TEST(RobustRotation, OfNothingIsNone) {
  EXPECT_TRUE(robustRotation({}, kNoise_m, false).isIdentity());
}

TEST(AdaptiveVote, IsTheMeanOfTheLargestSet) {
  EXPECT_DOUBLE_EQ(adaptiveVote({9, 1.0, 1.1, 1.2, 5, 5.05, -3}, 0.1), 1.1);
  EXPECT_DOUBLE_EQ(adaptiveVote({4}, 0.1), 4);
  EXPECT_DOUBLE_EQ(adaptiveVote({}, 0.1), 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-100, 100), near(6.95, 7.05);
  std::vector<double> measurements;
  for (int i = 0; i < 1000; ++i) measurements.push_back(i < 50 ? near(random) : anywhere(random));
  EXPECT_NEAR(adaptiveVote(measurements, 0.05), 7, 0.02);
}

}  // namespace
}  // namespace lamp
