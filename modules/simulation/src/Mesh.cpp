#include "lamp/simulation/Mesh.h"

#include <Eigen/Geometry>

namespace lamp::simulation {

void Mesh::append(const Mesh& other) {
  const auto first = static_cast<uint32_t>(vertices.size());
  vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
  materials.insert(materials.end(), other.materials.begin(), other.materials.end());
  for (const auto& t : other.triangles)
    triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

Eigen::Vector3f Mesh::normal(size_t triangle) const {
  const auto& [a, b, c] = triangles[triangle];
  const Eigen::Vector3f cross = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
  const float length = cross.norm();
  return length > 0 ? Eigen::Vector3f(cross / length) : Eigen::Vector3f(0, 0, 0);
}

}  // namespace lamp::simulation
