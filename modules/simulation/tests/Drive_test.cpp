#include "lamp/simulation/Drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "TestHollow.h"
#include "lamp/simulation/SurfaceNets.h"

namespace lamp::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kStart = 1.6e9, kStep = 0.05, kWidth = 4;

/** A smooth drive with a bend of 90 degrees: along x, then along y. Its end may rise. */
class DriveTest : public testing::Test {
 protected:
  explicit DriveTest(double rise_m = 0)
      : points_{{0, 0, 0}, {30, 0, 0}, {30, 5, 0}, {30, 20, rise_m}},
        mesh_(mesh()),
        caster_(mesh_) {}

  /** To the dead end, back, and a little to it again. */
  std::vector<Leg> route() const {
    Leg there, back;
    for (const Vector3d& p : points_) there.points.push_back({p, kWidth});
    back.points.assign(there.points.rbegin(), there.points.rend());
    Leg again;
    again.points = {{points_[0], kWidth}, {0.5 * (points_[0] + points_[1]), kWidth}};
    return {there, back, again};
  }

  std::vector<StampedPose> drive(const std::vector<Leg>& legs, const DriveOptions& options,
                                 uint64_t seed = 1) const {
    return lamp::simulation::drive(legs, caster_, options, kStart, seed);
  }
  std::vector<StampedPose> drive(const DriveOptions& options, uint64_t seed = 1) const {
    return drive(route(), options, seed);
  }

  /** Horizontal distance from the middle of the way. */
  double offMiddle(const Vector3d& p) const {
    Layout layout;
    layout.passages.resize(1);
    layout.passages[0].floor = points_;
    return layout.distanceToPassages(p);
  }

  double aboveFloor(const Pose3& pose) const {
    const Vector3d above = pose.translation() + Vector3d(0, 0, 1);
    const auto hit = caster_.cast(above.cast<float>(), {0, 0, -1}, 10);
    return hit ? hit->range_m - 1 : 1e9;
  }

 private:
  Mesh mesh() const {
    FreeSpace space(1);
    const Vector3d more(3, 0, 0);
    space.add(test::hollow(points_[0] - more, points_[1] + more, kWidth));
    space.add(test::hollow(points_[1] - Vector3d(0, 2, 0), points_[2], kWidth));
    Hollow ramp = test::hollow(points_[2], points_[3], kWidth);
    ramp.level_m = 2;
    space.add(ramp);
    return wallMesh(space, 0.25);
  }

  std::vector<Vector3d> points_;
  Mesh mesh_;
  RayCaster caster_;
};

class RampTest : public DriveTest {
 protected:
  RampTest() : DriveTest(4.5) {}
};

double turnBetween(const StampedPose& a, const StampedPose& b) {
  return std::remainder(yawOf(b.pose) - yawOf(a.pose), 2 * M_PI);
}

double stepBetween(const StampedPose& a, const StampedPose& b) {
  return (b.pose.translation() - a.pose.translation()).norm();
}

TEST_F(DriveTest, StampsAreEvenlySpacedFromTheStart) {
  const auto poses = drive(DriveOptions());
  EXPECT_EQ(poses.front().stamp, kStart);
  for (size_t i = 0; i < poses.size(); ++i)
    EXPECT_NEAR(poses[i].stamp - kStart, kStep * static_cast<double>(i), 1e-3);
}

TEST_F(DriveTest, NeverJumps) {
  const DriveOptions options;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const auto poses = drive(options, seed);
    for (size_t i = 1; i < poses.size(); ++i) {
      EXPECT_LT(stepBetween(poses[i - 1], poses[i]), 1.5 * options.speed_mps * kStep);
      // On the spot by the turn rate; in curves a metre of radius takes half the speed.
      EXPECT_LT(std::abs(turnBetween(poses[i - 1], poses[i])), 1.5 * options.speed_mps * kStep);
      EXPECT_LT(rotationAngle(poses[i - 1].pose.inverse() * poses[i].pose), 0.12);
    }
  }
}

TEST_F(RampTest, NeverTipsOver) {
  const auto poses = drive(DriveOptions());
  double steepest = 0;
  for (size_t i = 1; i < poses.size(); ++i) {
    EXPECT_LT(rotationAngle(poses[i - 1].pose.inverse() * poses[i].pose), 0.12)
        << "at " << poses[i].pose.translation().transpose();
    steepest = std::max(steepest, std::abs(yawPitchRollFromPose(poses[i].pose)[4]));
  }
  EXPECT_NEAR(steepest, std::atan(0.3), 0.05) << "pitched as the ramp is";
}

TEST_F(RampTest, PitchFollowsTheSlope) {
  DriveOptions level;
  level.sway_deg = 0;
  const auto poses = drive(level);
  size_t moving = 0;
  for (size_t i = 1; i < poses.size(); ++i) {
    const Vector3d motion = poses[i].pose.translation() - poses[i - 1].pose.translation();
    if (motion.norm() < 0.03) continue;
    ++moving;
    EXPECT_GT(motion.normalized().dot(poses[i].pose.linear().col(0)), 0.97)
        << "the robot drives where it looks, at " << poses[i].pose.translation().transpose();
  }
  EXPECT_GT(moving, poses.size() / 2);
}

TEST_F(DriveTest, StaysNearTheMiddleOfTheWay) {
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    double farthest = 0;
    for (const StampedPose& pose : drive(DriveOptions(), seed))
      farthest = std::max(farthest, offMiddle(pose.pose.translation()));
    EXPECT_LT(farthest, 0.5 * kWidth - 0.5);
    EXPECT_GT(farthest, 0.2) << "but not on it";
  }
}

TEST_F(DriveTest, WithoutWanderItOnlyCutsTheCorner) {
  DriveOptions options;
  options.wander_m = 0;
  const auto poses = drive(options);
  ASSERT_FALSE(poses.empty());
  for (const StampedPose& pose : poses) {
    const Vector3d p = pose.pose.translation();
    const double to_corner = (p - Vector3d(30, 0, 0)).norm();
    EXPECT_LT(offMiddle(p), to_corner > 5 ? 0.01 : 0.8);
  }
}

TEST_F(RampTest, StandsOnTheFloor) {
  const auto poses = drive(DriveOptions());
  ASSERT_FALSE(poses.empty());
  for (const StampedPose& pose : poses) EXPECT_LT(std::abs(aboveFloor(pose.pose)), 0.15);
}

TEST_F(DriveTest, TurnsOnTheSpotAtReversals) {
  DriveOptions options;
  options.halt_s = 0;
  const auto poses = drive(options);
  double turned = 0;
  for (size_t i = 1; i < poses.size(); ++i) {
    if (stepBetween(poses[i - 1], poses[i]) > 1e-9) continue;
    turned += std::abs(turnBetween(poses[i - 1], poses[i]));
    EXPECT_LT(std::abs(turnBetween(poses[i - 1], poses[i])),
              1.01 * kStep * options.turn_rate_dps * M_PI / 180);
  }
  EXPECT_NEAR(turned, 2 * M_PI, 0.3) << "twice by half a turn";
}

/** Lengths of the times, in seconds, over which neither place nor heading changes. */
std::vector<double> rests(const std::vector<StampedPose>& poses) {
  std::vector<double> found;
  double since = poses.front().stamp;
  for (size_t i = 1; i < poses.size(); ++i) {
    if (poses[i].pose.isApprox(poses[i - 1].pose, 1e-12)) continue;
    if (poses[i].stamp - since > 0.5) found.push_back(poses[i].stamp - since);
    since = poses[i].stamp;
  }
  return found;
}

TEST_F(DriveTest, HaltsNowAndThen) {
  DriveOptions options;
  options.halt_every_m = 20;
  options.halt_s = 4;
  const auto halts = rests(drive(options));
  EXPECT_GE(halts.size(), 3u) << "in 115 m";
  EXPECT_LE(halts.size(), 10u);
  for (const double halt : halts) {
    EXPECT_GE(halt, 1.9);
    EXPECT_LE(halt, 6.2);
  }
  options.halt_s = 0;
  EXPECT_TRUE(rests(drive(options)).empty());
}

TEST_F(DriveTest, DrivesAtItsSpeedOnStraightWays) {
  DriveOptions options;
  options.halt_s = 0;
  options.wander_m = 0;
  const auto poses = drive(options);
  size_t straight = 0;
  for (const StampedPose& pose : poses) {
    const Vector3d p = pose.pose.translation();
    if (p.x() > 20) break;
    EXPECT_NEAR(p.x(), options.speed_mps * (pose.stamp - kStart), 0.1);
    ++straight;
  }
  EXPECT_GT(straight, 100u);
}

TEST_F(DriveTest, TheSeedDecidesTheDrive) {
  const auto one = drive(DriveOptions(), 1), same = drive(DriveOptions(), 1),
             other = drive(DriveOptions(), 2);
  ASSERT_EQ(one.size(), same.size());
  for (size_t i = 0; i < one.size(); ++i)
    EXPECT_TRUE(one[i].pose.matrix() == same[i].pose.matrix());
  double apart = 0;
  for (size_t i = 0; i < std::min(one.size(), other.size()); ++i)
    apart = std::max(apart, stepBetween(one[i], other[i]));
  EXPECT_GT(apart, 0.2);
}

TEST_F(DriveTest, ARouteWithoutLengthIsAFault) {
  Leg point;
  point.points = {{{1, 0, 0}, kWidth}};
  EXPECT_THROW(drive({point}, DriveOptions()), std::logic_error);
  EXPECT_THROW(drive(std::vector<Leg>{}, DriveOptions()), std::logic_error);
}

}  // namespace
}  // namespace lamp::simulation
