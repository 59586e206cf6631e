#pragma once

#include "lamp/simulation/Mesh.h"

namespace lamp::test {

using namespace simulation;

/** Two triangles; a, b, c, d counter-clockwise seen from free space. */
inline void addQuad(Mesh& mesh, const Eigen::Vector3f& a, const Eigen::Vector3f& b,
                    const Eigen::Vector3f& c, const Eigen::Vector3f& d,
                    Material material = Material::kConcrete) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
  mesh.materials.insert(mesh.materials.end(), 2, material);
}

/** The inside of a box around the origin, `half` its half size. */
inline Mesh room(const Eigen::Vector3f& half, Material material = Material::kConcrete) {
  const float x = half.x(), y = half.y(), z = half.z();
  Mesh mesh;
  addQuad(mesh, {x, y, -z}, {x, -y, -z}, {x, -y, z}, {x, y, z}, material);
  addQuad(mesh, {-x, -y, -z}, {-x, y, -z}, {-x, y, z}, {-x, -y, z}, material);
  addQuad(mesh, {-x, y, -z}, {x, y, -z}, {x, y, z}, {-x, y, z}, material);
  addQuad(mesh, {x, -y, -z}, {-x, -y, -z}, {-x, -y, z}, {x, -y, z}, material);
  addQuad(mesh, {-x, -y, -z}, {x, -y, -z}, {x, y, -z}, {-x, y, -z}, material);
  addQuad(mesh, {-x, y, z}, {x, y, z}, {x, -y, z}, {-x, -y, z}, material);
  return mesh;
}

/** A wall across the x axis at `x`, seen from smaller x. */
inline Mesh wallAt(float x, float half_size, Material material = Material::kConcrete) {
  const float h = half_size;
  Mesh mesh;
  addQuad(mesh, {x, h, -h}, {x, -h, -h}, {x, -h, h}, {x, h, h}, material);
  return mesh;
}

}  // namespace lamp::test
