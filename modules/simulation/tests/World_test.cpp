#include "lamp/simulation/World.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <queue>

#include "MeshTools.h"
#include "lamp/simulation/Drive.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Eigen::Vector3d;

/** A tenth of the paper's, but long enough for each part of the world. */
double lengthOf(const WorldKind& kind) {
  double sum = 0;
  for (const PaperRobot& robot : kind.robots) sum += robot.length_m;
  return std::max(150.0, 0.1 * sum);
}

std::vector<std::string> kindNames() {
  std::vector<std::string> names;
  for (const WorldKind& kind : worldKinds()) names.push_back(kind.name);
  return names;
}

/** A small world with coarse walls, in which a team of three has driven. */
class DrivenWorld {
 public:
  DrivenWorld(const WorldKind& kind, uint64_t seed)
      : world_(kind.make(lengthOf(kind), 2.5 * kind.cell_m, seed)), caster_(world_.mesh) {
    for (const auto& route : planRoutes(world_.layout, {220, 220, 220}, seed))
      drives_.push_back(drive(route, caster_, DriveOptions(), 0, seed));
  }

  void expectClosed() const {
    const auto directions = randomDirections(300, 5);
    size_t from_behind = 0, rays = 0;
    for (const Pose3& pose : poses(100)) {
      const Panorama seen = lookAround(caster_, pose * Vector3d(0, 0, 0.8), directions);
      EXPECT_EQ(seen.lost, 0u) << "at " << pose.translation().transpose();
      from_behind += seen.from_behind;
      rays += directions.size();
    }
    // Open ends of pipes and the backs of plates are seen from behind; rock never.
    EXPECT_LT(static_cast<double>(from_behind), 0.01 * static_cast<double>(rays));
  }

  void expectRobotsOnTheFloor() const {
    for (const Pose3& pose : poses(10)) {
      const Vector3d above = pose.translation() + Vector3d(0, 0, 1);
      const auto hit = caster_.cast(above.cast<float>(), {0, 0, -1}, 10);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->range_m, 1, 0.15) << "at " << pose.translation().transpose();
    }
  }

  void expectRobotsClearOfAllThatStands() const {
    for (const Pose3& pose : poses(10))
      for (const double height : {0.4, 0.8})
        for (int i = 0; i < 24; ++i) {
          const double angle = M_PI * i / 12;
          const Eigen::Vector3f direction =
              Vector3d(std::cos(angle), std::sin(angle), 0).cast<float>();
          const Vector3d eye = pose.translation() + Vector3d(0, 0, height);
          EXPECT_FALSE(caster_.cast(eye.cast<float>(), direction, 0.3f))
              << "at " << eye.transpose() << " towards " << direction.transpose();
        }
  }

  void expectSteadyMotion() const {
    for (const auto& drive : drives_)
      for (size_t i = 1; i < drive.size(); ++i) {
        const Pose3 motion = drive[i - 1].pose.inverse() * drive[i].pose;
        EXPECT_LT(motion.translation().norm(), 0.05 * 1.2 * 1.5);
        EXPECT_LT(rotationAngle(motion), 0.12) << drive[i].pose.translation().transpose();
      }
  }

  void expectPlatesInSightOfTheStart() const {
    ASSERT_EQ(world_.plates.size(), 3u);
    for (const Vector3d& plate : world_.plates)
      for (const double back : {2.0, 3.0, 4.0}) {
        const Vector3d eye = world_.world_T_gate * Vector3d(-back, 0.2, 0.8);
        const Vector3d towards = plate - eye;
        const auto hit = caster_.cast(eye.cast<float>(), towards.normalized().cast<float>(), 20);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->range_m, towards.norm(), 0.01);
        EXPECT_EQ(world_.mesh.materials[hit->triangle], Material::kReflector);
        EXPECT_LT(world_.mesh.normal(hit->triangle).cast<double>().dot(towards), 0);
      }
  }

  void expectRobotsThroughTheGate() const {
    for (const auto& drive : drives_) {
      EXPECT_LT((world_.world_T_gate.inverse() * drive.front().pose.translation()).x(), -2);
      double nearest = 1e9;
      for (const StampedPose& pose : drive)
        nearest =
            std::min(nearest, (world_.world_T_gate.translation() - pose.pose.translation()).norm());
      EXPECT_LT(nearest, 1) << "through its middle";
    }
  }

  void expectArtifactsInFreeSpace() const {
    const auto directions = randomDirections(500, 6);
    EXPECT_GE(world_.artifacts.size(), 4u);
    for (const Artifact& artifact : world_.artifacts) {
      const Panorama seen = lookAround(caster_, artifact.position, directions);
      EXPECT_EQ(seen.lost, 0u) << artifact.position.transpose();
      EXPECT_LT(seen.from_behind, directions.size() / 10) << artifact.position.transpose();
      EXPECT_GT(seen.nearest_m, 0.03f) << artifact.position.transpose();
    }
  }

 private:
  /** Every `stride`-th pose of all robots. */
  std::vector<Pose3> poses(size_t stride) const {
    std::vector<Pose3> all;
    for (const auto& drive : drives_)
      for (size_t i = 0; i < drive.size(); i += stride) all.push_back(drive[i].pose);
    return all;
  }

  const World world_;
  const RayCaster caster_;
  std::vector<std::vector<StampedPose>> drives_;
};

class Worlds : public testing::TestWithParam<std::string> {
 protected:
  const WorldKind& kind() const { return worldKind(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(All, Worlds, testing::ValuesIn(kindNames()),
                         [](const auto& kind) { return kind.param; });

// One test for all of it: a world takes longer to make than to look at.
TEST_P(Worlds, AreClosedAndCanBeDriven) {
  for (const uint64_t seed : {7, 11}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DrivenWorld world(kind(), seed);
    world.expectClosed();
    world.expectRobotsOnTheFloor();
    world.expectRobotsClearOfAllThatStands();
    world.expectSteadyMotion();
    world.expectPlatesInSightOfTheStart();
    world.expectRobotsThroughTheGate();
    world.expectArtifactsInFreeSpace();
  }
}

/** Places that passages join to the gate. */
std::vector<bool> reachable(const Layout& layout) {
  std::vector<bool> reached(layout.places.size(), false);
  std::queue<size_t> queue;
  queue.push(layout.gate);
  reached[layout.gate] = true;
  while (!queue.empty()) {
    const size_t place = queue.front();
    queue.pop();
    for (const size_t i : layout.passagesAt(place))
      for (const size_t end : {layout.passages[i].from, layout.passages[i].to}) {
        if (!reached[end]) queue.push(end);
        reached[end] = true;
      }
  }
  return reached;
}

void expectLoopsAndDeadEnds(const Layout& layout) {
  const std::vector<bool> reached = reachable(layout);
  const auto places = std::count(reached.begin(), reached.end(), true);
  int dead_ends = 0;
  for (size_t i = 0; i < layout.places.size(); ++i)
    dead_ends += i != layout.gate && layout.passagesAt(i).size() == 1;
  EXPECT_GE(static_cast<ptrdiff_t>(layout.passages.size()) - places + 1, 1) << "independent loops";
  EXPECT_GE(dead_ends, 1);
}

void expectLookAlikesInReach(const Layout& layout) {
  for (const auto& group : layout.look_alikes) {
    EXPECT_GE(group.size(), 2u);
    for (const Vector3d& spot : group)
      EXPECT_LT(layout.distanceToPassages(spot), 0.1) << spot.transpose();
  }
}

TEST_P(Worlds, HaveLoopsDeadEndsAndLookAlikes) {
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    // The walls do not matter here: their cells may be as wide as a drive.
    const Layout layout = kind().make(lengthOf(kind()), 4, seed).layout;
    const std::vector<bool> reached = reachable(layout);
    for (const Passage& passage : layout.passages)
      EXPECT_TRUE(reached[passage.from]) << layout.places[passage.from].transpose();
    expectLoopsAndDeadEnds(layout);
    expectLookAlikesInReach(layout);
    EXPECT_EQ(layout.look_alikes.empty(), GetParam() == "demo");
  }
}

TEST_P(Worlds, DifferWithTheSeedOnly) {
  const auto made = [&](uint64_t seed) { return kind().make(lengthOf(kind()), 1, seed); };
  const World one = made(3), same = made(3), other = made(4);
  EXPECT_TRUE(sameMesh(one.mesh, same.mesh));
  EXPECT_EQ(one.plates, same.plates);
  ASSERT_EQ(one.artifacts.size(), same.artifacts.size());
  for (size_t i = 0; i < one.artifacts.size(); ++i)
    EXPECT_EQ(one.artifacts[i].position, same.artifacts[i].position);
  EXPECT_FALSE(sameMesh(one.mesh, other.mesh));
  EXPECT_NE(one.artifacts[0].position, other.artifacts[0].position);
}

TEST_P(Worlds, GrowWithTheDistance) {
  const auto drives = [&](double length_m) {
    double sum = 0;
    for (const Passage& passage : kind().make(length_m, 4, 3).layout.passages)
      sum += passage.length();
    return sum;
  };
  const double small = drives(300), large = drives(1500);
  EXPECT_GT(large, 1.8 * small);
}

TEST(WorldKinds, AreThoseOfThePaper) {
  EXPECT_EQ(kindNames(), (std::vector<std::string>{"tunnel", "urban", "finals", "ku", "demo"}));
  const std::map<std::string, std::pair<size_t, double>> paper = {
      {"tunnel", {2, 2500}}, {"urban", {3, 1500}}, {"finals", {4, 1200}}, {"ku", {4, 6300}}};
  for (const auto& [name, expected] : paper) {
    double sum = 0;
    for (const PaperRobot& robot : worldKind(name).robots) sum += robot.length_m;
    EXPECT_EQ(worldKind(name).robots.size(), expected.first) << name;
    EXPECT_NEAR(sum / expected.second, 1, 0.05) << name;
  }
}

TEST(WorldKinds, AnUnknownOneIsAFaultThatListsTheKnown) {
  try {
    worldKind("tunel");
    FAIL() << "there is no such world";
  } catch (const std::runtime_error& error) {
    for (const std::string word : {"tunel", "tunnel", "urban", "finals", "ku", "demo"})
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace lamp::simulation
