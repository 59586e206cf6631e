#include "lamp/simulation/Solids.h"

#include <algorithm>
#include <cmath>

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

constexpr double kWidestTriangleM = 0.3;

/** A grid of triangles over a parallelogram, counter-clockwise seen against `u × v`. */
void addFace(const Vector3d& corner, const Vector3d& u, const Vector3d& v, Material material,
             Mesh& mesh) {
  const int columns = std::max(1, static_cast<int>(std::ceil(u.norm() / kWidestTriangleM)));
  const int rows = std::max(1, static_cast<int>(std::ceil(v.norm() / kWidestTriangleM)));
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
      mesh.vertices.push_back((corner + u * column / columns + v * row / rows).cast<float>());
  const auto at = [&](int row, int column) {
    return first + static_cast<uint32_t>(row * (columns + 1) + column);
  };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      mesh.triangles.push_back({at(row, column), at(row, column + 1), at(row + 1, column + 1)});
      mesh.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row + 1, column)});
      mesh.materials.insert(mesh.materials.end(), 2, material);
    }
}

}  // namespace

Mesh box(const Eigen::Isometry3d& world_T_box, const Vector3d& size, Material material) {
  Mesh mesh;
  const Vector3d x = world_T_box.linear().col(0) * size.x();
  const Vector3d y = world_T_box.linear().col(1) * size.y();
  const Vector3d z = world_T_box.linear().col(2) * size.z();
  const Vector3d corner = world_T_box.translation() - 0.5 * x - 0.5 * y;
  addFace(corner + z, x, y, material, mesh);
  addFace(corner, y, x, material, mesh);
  addFace(corner, x, z, material, mesh);
  addFace(corner + y, z, x, material, mesh);
  addFace(corner, z, y, material, mesh);
  addFace(corner + x, y, z, material, mesh);
  return mesh;
}

Mesh pipe(const Vector3d& from, const Vector3d& to, double radius_m, int sides, Material material) {
  Mesh mesh;
  const Vector3d axis = to - from;
  const Vector3d side = axis.unitOrthogonal(), other = axis.normalized().cross(side);
  const auto rim = [&](int i) {
    const double angle = 2.0 * M_PI * i / sides;
    return Vector3d(from + radius_m * (std::cos(angle) * side + std::sin(angle) * other));
  };
  for (int i = 0; i < sides; ++i) addFace(rim(i), rim(i + 1) - rim(i), axis, material, mesh);
  return mesh;
}

Mesh boulder(const Vector3d& foot, double radius_m, Random& random) {
  constexpr int kRings = 6, kSides = 8;
  Mesh mesh;
  const Vector3d middle = foot + Vector3d(0, 0, 0.4 * radius_m);
  const Vector3d stretch(uniform(random, 0.7, 1.3), uniform(random, 0.7, 1.3),
                         uniform(random, 0.5, 0.9));
  for (int ring = 0; ring <= kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      const double polar = M_PI * ring / kRings, azimuth = 2.0 * M_PI * side / kSides;
      const bool pole = ring == 0 || ring == kRings;
      const double r = radius_m * (pole ? 1.0 : uniform(random, 0.75, 1.15));
      const Vector3d direction(std::sin(polar) * std::cos(azimuth),
                               std::sin(polar) * std::sin(azimuth), std::cos(polar));
      mesh.vertices.push_back((middle + r * stretch.cwiseProduct(direction)).cast<float>());
    }
  const auto at = [&](int ring, int side) {
    return static_cast<uint32_t>(ring * kSides + side % kSides);
  };
  for (int ring = 0; ring < kRings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      if (ring + 1 < kRings)
        mesh.triangles.push_back({at(ring, side), at(ring + 1, side), at(ring + 1, side + 1)});
      if (ring > 0)
        mesh.triangles.push_back({at(ring, side), at(ring + 1, side + 1), at(ring, side + 1)});
    }
  mesh.materials.assign(mesh.triangles.size(), Material::kRock);
  return mesh;
}

Mesh plate(const Eigen::Isometry3d& world_T_plate, const Eigen::Vector2d& size, Material material) {
  Mesh mesh;
  const Vector3d across = world_T_plate.linear().col(1) * size.x();
  const Vector3d up = world_T_plate.linear().col(2) * size.y();
  addFace(world_T_plate.translation() - 0.5 * across - 0.5 * up, across, up, material, mesh);
  return mesh;
}

}  // namespace lamp::simulation
