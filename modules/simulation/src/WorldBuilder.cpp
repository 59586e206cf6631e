#include "WorldBuilder.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lamp/simulation/SurfaceNets.h"

namespace lamp::simulation {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/** Clearance that a robot needs beside the middle of its way. */
constexpr double kClearanceM = 1.2;
/** ... and around a corner that it cuts. */
constexpr double kCornerClearanceM = 2.0;
constexpr double kGateM = 4.0;

Pose3 poseAt(const Vector3d& position, double yaw) {
  return poseFromYawPitchRoll((Vector6d() << position, yaw, 0, 0).finished());
}

/** How far rock stands out into a passage at most: noise hardly goes beyond 0.7. */
double bulgeOf(const WallStyle& wall) {
  return 0.7 * (1.5 * wall.roughness_m + wall.waviness_m);
}

}  // namespace

size_t WorldBuilder::addPlace(const Vector3d& floor) {
  world_.layout.places.push_back(floor);
  return world_.layout.places.size() - 1;
}

size_t WorldBuilder::addPassage(size_t from, size_t to, const PassageStyle& style,
                                const std::vector<Vector3d>& between) {
  Passage passage;
  passage.from = from;
  passage.to = to;
  passage.width_m = std::max(1.0, style.width_m - 2 * bulgeOf(style.wall));
  passage.floor = {world_.layout.places[from]};
  passage.floor.insert(passage.floor.end(), between.begin(), between.end());
  passage.floor.push_back(world_.layout.places[to]);
  for (size_t i = 1; i < passage.floor.size(); ++i) {
    // Longer by half the width at both ends: where hollows meet, no edge is left standing.
    const Vector3d a = passage.floor[i - 1], b = passage.floor[i];
    Vector3d along = b - a;
    along.z() = 0;
    const Vector3d more = along.norm() > 0 ? Vector3d(along.normalized() * 0.5 * style.width_m)
                                           : Vector3d(Vector3d::Zero());
    Hollow hollow;
    hollow.from = a;
    hollow.to = b;
    // A slope must not go on beyond its ends, but there its floor must not be a rounded edge.
    const bool level = std::abs(a.z() - b.z()) < 0.01;
    if (level) {
      hollow.from -= more;
      hollow.to += more;
    } else {
      hollow.level_m = style.corner_m;
    }
    hollow.width_m = style.width_m;
    hollow.height_m = style.height_m;
    hollow.corner_m = style.corner_m;
    hollow.style = style.wall;
    space_.add(hollow);
  }
  world_.layout.passages.push_back(std::move(passage));
  styles_.push_back(style);
  return styles_.size() - 1;
}

void WorldBuilder::addRoom(const Vector3d& floor, const Vector3d& size, double yaw,
                           const WallStyle& wall) {
  const Vector3d half = 0.5 * size.x() * Vector3d(std::cos(yaw), std::sin(yaw), 0);
  Hollow hollow;
  hollow.from = floor - half;
  hollow.to = floor + half;
  hollow.width_m = size.y();
  hollow.height_m = size.z();
  hollow.corner_m = wall.material == Material::kRock ? 0.4 * std::min(size.y(), size.z()) : 0.05;
  hollow.style = wall;
  space_.add(hollow);
}

void WorldBuilder::addSolid(const Mesh& solid) {
  Eigen::AlignedBox3d around;
  for (const Eigen::Vector3f& vertex : solid.vertices) around.extend(vertex.cast<double>());
  solids_.push_back(around);
  world_.mesh.append(solid);
}

void WorldBuilder::addLookAlikes(std::vector<Vector3d> spots) {
  world_.layout.look_alikes.push_back(std::move(spots));
}

Pose3 WorldBuilder::alongPassage(size_t passage, double share) const {
  const Passage& way = world_.layout.passages[passage];
  double left = share * way.length();
  for (size_t i = 1; i < way.floor.size(); ++i) {
    const Vector3d along = way.floor[i] - way.floor[i - 1];
    const double length = along.norm();
    if (left <= length || i + 1 == way.floor.size())
      return poseAt(way.floor[i - 1] + along * (length > 0 ? left / length : 0),
                    std::atan2(along.y(), along.x()));
    left -= length;
  }
  return Pose3::Identity();
}

bool WorldBuilder::isDriven(const Vector3d& p, double clearance_m) const {
  return world_.layout.distanceToPassages(p) < clearance_m;
}

bool WorldBuilder::isAtCorner(const Vector3d& p, double clearance_m) const {
  const auto& places = world_.layout.places;
  return std::any_of(places.begin(), places.end(),
                     [&](const Vector3d& place) { return (place - p).norm() < clearance_m; });
}

bool WorldBuilder::isFree(const Vector3d& p, double clearance_m) const {
  const FreeSpace::Parts parts = space_.partsIn({p, p});
  if (parts.hollows.empty()) return false;
  if (space_.rough(p, space_.smooth(p, parts)) > -clearance_m) return false;
  return std::none_of(solids_.begin(), solids_.end(), [&](const Eigen::AlignedBox3d& solid) {
    return solid.squaredExteriorDistance(p) < clearance_m * clearance_m;
  });
}

void WorldBuilder::addRubble(size_t passage, double spacing_m, double largest_m) {
  const double length = world_.layout.passages[passage].length();
  const double wall = 0.5 * styleOf(passage).width_m;
  for (double at = uniform(random_, 0, spacing_m); at < length;
       at += spacing_m * uniform(random_, 0.3, 1.7)) {
    const double radius = largest_m * std::pow(uniform(random_, 0.0, 1.0), 2) + 0.12;
    const double side = chance(random_, 0.5) ? 1.0 : -1.0;
    const Vector3d foot = alongPassage(passage, at / length) *
                          Vector3d(0, side * (wall - uniform(random_, 0.0, 0.5)), 0);
    const double reach = 1.5 * radius;  // of the widest boulder
    if (!isDriven(foot, kClearanceM + reach) && !isAtCorner(foot, kCornerClearanceM + reach))
      addSolid(boulder(foot, radius, random_));
  }
}

void WorldBuilder::addPipe(size_t passage, double height_m, double radius_m, int side) {
  const double length = world_.layout.passages[passage].length();
  const double wall = 0.5 * styleOf(passage).width_m;
  const auto at = [&](double share) {
    return Vector3d(alongPassage(passage, share) *
                    Vector3d(0, side * (wall - radius_m - 0.15), height_m));
  };
  const int pieces = std::max(1, static_cast<int>(length / 6.0));
  for (int i = 0; i < pieces; ++i) {
    const Vector3d a = at(static_cast<double>(i) / pieces),
                   b = at(static_cast<double>(i + 1) / pieces);
    if (isDriven({0.5 * (a + b)}, 0.9)) continue;  // where another passage crosses
    addSolid(pipe(a, b, radius_m, 8, Material::kMetal));
    const Vector3d flange = 0.12 * (b - a).normalized();
    addSolid(pipe(a, a + flange, 1.5 * radius_m, 8, Material::kMetal));
  }
}

void WorldBuilder::addSupports(size_t passage, double spacing_m) {
  const PassageStyle& style = styleOf(passage);
  const double length = world_.layout.passages[passage].length();
  constexpr double kPostM = 0.22;
  const double wall = 0.5 * style.width_m - 0.5;
  for (double at = spacing_m; at < length - 0.5 * spacing_m; at += spacing_m) {
    const Pose3 middle = alongPassage(passage, at / length);
    bool crossing = false;
    for (const double side : {-1.0, 1.0})
      crossing = crossing || isDriven(middle * Vector3d(0, side * wall, 0), 0.9);
    if (crossing) continue;
    for (const double side : {-1.0, 1.0}) {
      const Vector3d foot = middle * Vector3d(0, side * wall, -0.2);
      addSolid(
          pipe(foot, foot + Vector3d(0, 0, style.height_m), 0.5 * kPostM, 8, Material::kConcrete));
    }
    addSolid(box(middle * poseAt({0, 0, style.height_m - 0.45}, 0), {kPostM, style.width_m, kPostM},
                 Material::kConcrete));
  }
}

void WorldBuilder::addDoorFrame(size_t passage, double share, double width_m, double height_m) {
  const PassageStyle& style = styleOf(passage);
  double& drivable = world_.layout.passages[passage].width_m;
  drivable = std::min(drivable, width_m);
  const Pose3 middle = alongPassage(passage, share);
  const double beside = 0.5 * (style.width_m - width_m) + 0.3;
  for (const double side : {-1.0, 1.0})
    addSolid(box(middle * poseAt({0, side * (0.5 * width_m + 0.5 * beside), -0.1}, 0),
                 {0.2, beside, style.height_m + 0.3}, Material::kConcrete));
  addSolid(box(middle * poseAt({0, 0, height_m}, 0),
               {0.2, width_m, std::max(0.1, style.height_m - height_m + 0.2)},
               Material::kConcrete));
}

void WorldBuilder::addClutter(const Vector3d& floor, double reach_m, int count, Random& random) {
  for (int i = 0; i < count; ++i) {
    const Vector3d foot =
        floor + Vector3d(uniform(random, -reach_m, reach_m), uniform(random, -reach_m, reach_m), 0);
    const Vector3d size(uniform(random, 0.4, 1.6), uniform(random, 0.4, 1.0),
                        uniform(random, 0.5, 2.0));
    const Pose3 pose = poseAt(foot, uniform(random, 0, M_PI));
    const bool metal = chance(random, 0.5);
    if (!isDriven(foot, kClearanceM + 0.8))
      addSolid(box(pose, size, metal ? Material::kMetal : Material::kConcrete));
  }
}

void WorldBuilder::addDistractors(int count) {
  for (int i = 0; i < count; ++i) {
    const size_t passage = pick(random_, styles_.size());
    const double wall = 0.5 * styleOf(passage).width_m - 0.25;
    const double side = chance(random_, 0.5) ? 1.0 : -1.0;
    const Pose3 sign = alongPassage(passage, uniform(random_, 0.1, 0.9)) *
                       poseAt({0, side * wall, uniform(random_, 0.8, 1.8)}, -side * M_PI / 2);
    if (isDriven(sign.translation(), 0.9) || sign.translation().head<2>().norm() < 12) continue;
    addSolid(plate(sign, {uniform(random_, 0.2, 0.6), uniform(random_, 0.2, 0.6)},
                   Material::kReflector));
  }
}

void WorldBuilder::addGate() {
  const size_t first = world_.layout.passagesAt(world_.layout.gate).front();
  const Pose3 start = alongPassage(first, 0);
  world_.world_T_gate = start * poseAt({kGateM, 0, 0}, 0);
  const PassageStyle& style = styleOf(first);
  constexpr double kWidthM = 2.6, kHeightM = 1.9, kBarM = 0.1, kPlateM = 0.3;
  for (const double side : {-1.0, 1.0})
    addSolid(box(world_.world_T_gate * poseAt({0, side * 0.5 * kWidthM, 0}, 0),
                 {kBarM, kBarM, kHeightM}, Material::kMetal));
  addSolid(box(world_.world_T_gate * poseAt({0, 0, kHeightM}, 0), {kBarM, kWidthM, kBarM},
               Material::kMetal));
  // Not symmetric, so that they tell left from right, and as low as a lidar with a field of view of
  // 15 degrees upwards sees from where robots wait.
  for (const Vector3d& middle :
       {Vector3d(-0.08, 0.5 * kWidthM, 1.5), Vector3d(-0.08, -0.5 * kWidthM, 0.9),
        Vector3d(-0.08, 0.3, 1.7)}) {
    const Pose3 facing_robots = world_.world_T_gate * poseAt(middle, M_PI);
    addSolid(plate(facing_robots, {kPlateM, kPlateM}, Material::kReflector));
    world_.plates.push_back(facing_robots.translation());
  }
  // Where robots wait before the start.
  addRoom(start * Vector3d(-3, 0, 0), {9, std::max(7.0, style.width_m), style.height_m},
          yawOf(start), style.wall);
}

void WorldBuilder::addArtifacts(int count) {
  static const char* const kKinds[] = {"backpack",     "survivor", "phone", "drill",
                                       "extinguisher", "helmet",   "rope"};
  constexpr double kClearM = 0.1;
  const auto somewhere = [&] {
    const size_t passage = pick(random_, styles_.size());
    const double side = uniform(random_, -1, 1) * (0.5 * styleOf(passage).width_m - 0.6);
    return Vector3d(alongPassage(passage, uniform(random_, 0.1, 0.9)) *
                    Vector3d(0, side, uniform(random_, 0.2, 1.0)));
  };
  for (int i = 0; i < count; ++i) {
    Vector3d at = somewhere();
    for (int attempt = 0; attempt < 100 && !isFree(at, kClearM); ++attempt) at = somewhere();
    world_.artifacts.push_back({i, kKinds[static_cast<size_t>(i) % std::size(kKinds)], at});
  }
}

World WorldBuilder::build(double cell_m) {
  Mesh mesh = wallMesh(space_, cell_m);
  mesh.append(world_.mesh);
  world_.mesh = std::move(mesh);
  return std::move(world_);
}

}  // namespace lamp::simulation
