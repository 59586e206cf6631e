#include "lamp/base_station/RobotPlacements.h"

#include <gtest/gtest.h>

#include <tuple>

#include "TestTeam.h"

namespace lamp {
namespace {

using namespace test;

struct Box {
  Eigen::Array3d low, high;

  /** Distance along the ray, from outside; infinite if it passes. */
  double hit(const Eigen::Array3d& from, const Eigen::Array3d& ray) const {
    const Eigen::Array3d to_low = (low - from) / ray, to_high = (high - from) / ray;
    const double enter = to_low.min(to_high).maxCoeff(), leave = to_low.max(to_high).minCoeff();
    return enter > 0 && enter < leave ? enter : INFINITY;
  }
};

/** A corridor of 4 x 3 m along x, with a pillar on both sides every 3 m, seen up to 15 m. */
class Corridor {
 public:
  Corridor() {
    for (double x = 0; x < 120; x += 3) {
      boxes_.push_back({{x, 1.5, -1}, {x + 0.5, 2, 2}});
      boxes_.push_back({{x, -2, -1}, {x + 0.5, -1.5, 2}});
    }
  }
  void addCrate(double x) { boxes_.push_back({{x, 0.2, -1}, {x + 1.2, 1.5, 0.8}}); }

  KeyedScanPtr scan(const Pose3& world_T_base, unsigned seed, bool planar) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0, 0.01);
    auto scan = std::make_shared<Scan>();
    const int rings = planar ? 0 : 15, step = planar ? 1 : 2;
    for (int ring = -rings; ring <= rings; ring += 2)
      for (int azimuth = 0; azimuth < 360; azimuth += step) {
        const double a = azimuth * M_PI / 180, e = ring * M_PI / 180;
        const Eigen::Vector3d ray(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e),
                                  std::sin(e));
        const double range = hit(world_T_base, world_T_base.linear() * ray) + noise(random);
        if (range < 15) scan->points.push_back((range * ray).cast<float>());
      }
    scan->sensor.assign(scan->points.size(), 0);
    scan->sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
    return scan;
  }

 private:
  double hit(const Pose3& world_T_base, const Eigen::Vector3d& ray) const {
    const Eigen::Vector3d& from = world_T_base.translation();
    double range =
        std::min(((ray.y() > 0 ? 2 : -2) - from.y()) / ray.y(),
                 ray.z() == 0 ? INFINITY : ((ray.z() > 0 ? 2 : -1) - from.z()) / ray.z());
    for (const Box& box : boxes_) range = std::min(range, box.hit(from.array(), ray.array()));
    return range;
  }

  std::vector<Box> boxes_;
};

/** A drive of 20 m along the corridor, a key node every 2 m. */
std::vector<KeyNodePacket> driveAlong(const Corridor& corridor, RobotId robot, double from,
                                      double direction, bool planar = false) {
  std::vector<KeyNodePacket> packets;
  for (uint32_t k = 0; k <= 10; ++k) {
    // Not exactly along the axes: rays must not run within the boxes' faces.
    const Pose3 truth = planarPose(from + direction * 2.0 * k, 0.013, direction > 0 ? 0.001 : M_PI);
    KeyNodePacket packet;
    packet.id = {robot, k};
    packet.stamp = 1000 + 2.0 * k + 0.1 * robot.value;
    packet.odom_T_base = planarPose(2.0 * k, 0, 0);
    packet.planar = planar;
    packet.scan = corridor.scan(truth, 100 * (robot.value + 1u) + k, planar);
    Vector6d sigmas;
    sigmas << 0.04, 0.04, 0.04, 0.005, 0.005, 0.005;
    if (k > 0)
      packet.odometry =
          OdometryEdge{planarPose(2, 0, 0), Matrix6d(sigmas.cwiseAbs2().asDiagonal())};
    packets.push_back(packet);
  }
  return packets;
}

/** Robots without start poses; each registration starts where both key nodes are at one place, so
 * that many loop closures agree on whatever is near that. */
class LookAlikes : public testing::Test {
 protected:
  void run(const std::vector<KeyNodePacket>& a, const std::vector<KeyNodePacket>& b) {
    for (size_t k = 0; k < std::max(a.size(), b.size()); ++k) {
      if (k < a.size()) station_.base.receive(a[k]);
      if (k < b.size()) station_.base.receive(b[k]);
    }
    for (const RobotId robot : {a.front().id.robot, b.front().id.robot})
      station_.base.receive(RobotEnd{robot, {}});
    const std::atomic<bool> interrupted{false};
    station_.base.finish(interrupted);
  }

  const BaseStation& base() const { return station_.base; }
  size_t components() const { return base().graph().components().size(); }
  std::vector<Pose3> equallyGood() const {
    for (const FrameAgreement& frames : base().lastReport().frames)
      if (!frames.equally_good.empty()) {
        EXPECT_FALSE(frames.joined);
        return frames.equally_good;
      }
    return {};
  }
  /** Where b starts in the map, seen from a's start. */
  Pose3 startOfB() const {
    return base().graph().node({kA, 0}).world_T_base.inverse() *
           base().graph().node({kB, 0}).world_T_base;
  }

  Corridor corridor_;

 private:
  Station station_{
      "[pipeline]\ncandidates = PlaceRecognition\ninitial_aligner = OdometryGuess\nexporters =\n"};
};

TEST_F(LookAlikes, RobotsApartInARowOfPillarsStayApart) {
  run(driveAlong(corridor_, kA, 20, 1), driveAlong(corridor_, kB, 70, 1));
  EXPECT_EQ(components(), 2u);
  const std::vector<Pose3> placements = equallyGood();
  EXPECT_GE(placements.size(), 3u);
  // b starts 50 m farther on; what looks alike to that lies pillars away.
  for (const Pose3& placement : placements) {
    if (std::abs(yawOf(placement)) > 0.1) continue;
    const double pillars = (placement.translation().x() - 50) / 3;
    EXPECT_NEAR(pillars, std::round(pillars), 0.1) << placement.translation().transpose();
  }
}

TEST_F(LookAlikes, RobotsWith2dLasersAreNoException) {
  Corridor with_crate = corridor_;
  with_crate.addCrate(34);
  for (const auto& [corridor, start, maps] :
       {std::tuple(corridor_, 29.0, 2u), {corridor_, 70.0, 2u}, {with_crate, 29.0, 1u}}) {
    Station station{
        "[pipeline]\ncandidates = PlaceRecognition\n"
        "initial_aligner = OdometryGuess, PlanarSearch\nexporters =\n"};
    for (const auto& packets :
         {driveAlong(corridor, kA, 20, 1, true), driveAlong(corridor, kB, start, 1, true)})
      for (const KeyNodePacket& packet : packets) station.base.receive(packet);
    for (const RobotId robot : {kA, kB}) station.base.receive(RobotEnd{robot, {}});
    const std::atomic<bool> interrupted{false};
    station.base.finish(interrupted);
    EXPECT_GT(station.base.candidates(), 0u);
    EXPECT_EQ(station.base.graph().components().size(), maps) << start;
    if (maps > 1) continue;
    const PoseGraph& graph = station.base.graph();
    const Pose3 a_T_b =
        graph.node({kA, 0}).world_T_base.inverse() * graph.node({kB, 0}).world_T_base;
    EXPECT_NEAR(a_T_b.translation().x(), 9, 0.2);
  }
}

TEST_F(LookAlikes, SoDoRobotsThatOverlapWhereNothingTellsByHowMuch) {
  run(driveAlong(corridor_, kA, 20, 1), driveAlong(corridor_, kB, 29, 1));
  EXPECT_EQ(components(), 2u);
  EXPECT_GE(equallyGood().size(), 3u);
}

TEST_F(LookAlikes, ACrateThatBothHaveSeenTells) {
  corridor_.addCrate(34);
  run(driveAlong(corridor_, kA, 20, 1), driveAlong(corridor_, kB, 29, 1));
  EXPECT_EQ(components(), 1u);
  EXPECT_TRUE(equallyGood().empty());
  EXPECT_NEAR(startOfB().translation().x(), 9, 0.1);
  EXPECT_NEAR(startOfB().translation().y(), 0, 0.1);
}

TEST_F(LookAlikes, ACrateTellsTheWayRound) {
  corridor_.addCrate(34);
  run(driveAlong(corridor_, kA, 20, 1), driveAlong(corridor_, kB, 47, -1));
  EXPECT_EQ(components(), 1u);
  EXPECT_NEAR(startOfB().translation().x(), 27, 0.1);
  EXPECT_NEAR(std::abs(yawOf(startOfB())), M_PI, 0.02);
}

}  // namespace
}  // namespace lamp
