#include "lamp/frontend/GravityDetector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lamp {
namespace {

constexpr double kRate = 100;
const Eigen::Vector3d kUp = Eigen::Vector3d(0.2, -0.1, 1).normalized();

/** Feeds `seconds` of what a unit feels. \return the last answer. */
class Unit {
 public:
  template <class Force>
  std::optional<GravityReading> feel(double seconds, const Force& force,
                                     const Eigen::Vector3d& turn = Eigen::Vector3d::Zero()) {
    std::optional<GravityReading> last;
    for (int i = 0; i < seconds * kRate; ++i, stamp_ += 1 / kRate) {
      const Eigen::Vector3d noise(noise_(random_), noise_(random_), noise_(random_));
      last = detector_.observe(stamp_, {force(stamp_) + noise, turn});
    }
    return last;
  }

 private:
  GravityDetector detector_{GravityOptions{}};
  std::mt19937 random_{1};
  std::normal_distribution<double> noise_{0, 0.03};
  double stamp_ = 1000;
};

Eigen::Vector3d atRest(double) {
  return 9.8 * kUp;
}

TEST(GravityDetector, TellsUpAfterTheWindow) {
  Unit unit;
  EXPECT_FALSE(unit.feel(1.9, atRest));
  const auto up = unit.feel(0.3, atRest);
  ASSERT_TRUE(up);
  EXPECT_LT((up->base_up - kUp).norm(), 0.002);
  EXPECT_NEAR(up->sigma_rad, M_PI / 180, 1e-12);
  EXPECT_NEAR(up->stamp, 1002.2, 0.02);
}

TEST(GravityDetector, IsSilentWhileTheRobotTurnsOrAccelerates) {
  Unit turning;
  EXPECT_FALSE(turning.feel(5, atRest, {0, 0, 0.1}));
  Unit braking;
  braking.feel(1, atRest);
  EXPECT_FALSE(braking.feel(1, [](double t) {
    return Eigen::Vector3d(atRest(t).x() - 1, atRest(t).y(), atRest(t).z());
  }));
  Unit falling;
  EXPECT_FALSE(falling.feel(5, [](double) { return Eigen::Vector3d(0, 0, 1); }));
}

TEST(GravityDetector, IsSilentWhileTheRobotDrivesOverGroundThatShakesIt) {
  const auto shaking = [](double t) -> Eigen::Vector3d {
    return atRest(t) + std::sin(2 * M_PI * 7 * t) * Eigen::Vector3d(0.2, 0.1, 1.0);
  };
  Unit unit;
  EXPECT_TRUE(unit.feel(3, atRest));
  EXPECT_FALSE(unit.feel(5, shaking)) << "its mean is as at rest";
  EXPECT_TRUE(unit.feel(3, atRest));
  const auto fans = [&](double t) -> Eigen::Vector3d { return 0.8 * atRest(t) + 0.2 * shaking(t); };
  EXPECT_TRUE(unit.feel(3, fans));
}

TEST(GravityDetector, TurningStartsTheWindowAgain) {
  Unit unit;
  unit.feel(5, atRest);
  unit.feel(0.1, atRest, {0, 0, 0.1});
  EXPECT_FALSE(unit.feel(1.9, atRest));
  EXPECT_TRUE(unit.feel(0.3, atRest));
}

TEST(GravityDetector, StampsThatDoNotIncreaseAreIgnored) {
  GravityDetector detector{GravityOptions{}};
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(detector.observe(5.0, {9.8 * kUp, {0, 0, 0}}));
}

}  // namespace
}  // namespace lamp
