#pragma once

#include <array>
#include <map>
#include <random>
#include <vector>

#include "lamp/simulation/RayCaster.h"

namespace lamp::test {

using namespace simulation;

/** Even in all directions. */
inline std::vector<Eigen::Vector3f> randomDirections(size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<Eigen::Vector3f> directions;
  while (directions.size() < count) {
    const Eigen::Vector3f d(normal(random), normal(random), normal(random));
    if (d.norm() > 0.1f) directions.push_back(d.normalized());
  }
  return directions;
}

/** What rays from a point in all directions meet. */
struct Panorama {
  size_t lost = 0;         ///< rays that meet nothing
  size_t from_behind = 0;  ///< rays that meet a surface whose normal points away
  float nearest_m = 1e9f;
};

inline Panorama lookAround(const RayCaster& caster, const Eigen::Vector3d& eye,
                           const std::vector<Eigen::Vector3f>& directions) {
  Panorama seen;
  for (const Eigen::Vector3f& direction : directions) {
    const auto hit = caster.cast(eye.cast<float>(), direction, 1e4f);
    if (!hit) {
      ++seen.lost;
      continue;
    }
    seen.from_behind += caster.mesh().normal(hit->triangle).dot(direction) > 0;
    seen.nearest_m = std::min(seen.nearest_m, hit->range_m);
  }
  return seen;
}

inline double area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.vertices[b] - mesh.vertices[a])
                     .cross(mesh.vertices[c] - mesh.vertices[a])
                     .cast<double>()
                     .norm();
  return sum;
}

/** Enclosed volume by the divergence theorem, positive if normals point outwards. It depends on the
 * origin, unless the mesh is closed. */
inline double volume(const Mesh& mesh, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
  double sum = 0;
  const auto at = [&](uint32_t i) {
    return Eigen::Vector3d(mesh.vertices[i].cast<double>() - origin);
  };
  for (const auto& [a, b, c] : mesh.triangles) sum += at(a).dot(at(b).cross(at(c))) / 6.0;
  return sum;
}

/** Edges that do not have as many triangles on one side as on the other. Vertices at the very same
 * position count as one. */
inline size_t openEdges(const Mesh& mesh) {
  using Point = std::array<float, 3>;
  std::map<std::pair<Point, Point>, int> balance;
  for (const auto& triangle : mesh.triangles)
    for (size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3f &a = mesh.vertices[triangle[i]],
                            &b = mesh.vertices[triangle[(i + 1) % 3]];
      const Point p{a.x(), a.y(), a.z()}, q{b.x(), b.y(), b.z()};
      if (p == q) continue;
      p < q ? ++balance[{p, q}] : --balance[{q, p}];
    }
  size_t open = 0;
  for (const auto& [edge, count] : balance) open += count != 0;
  return open;
}

inline bool sameMesh(const Mesh& a, const Mesh& b) {
  return a.vertices == b.vertices && a.triangles == b.triangles && a.materials == b.materials;
}

}  // namespace lamp::test
