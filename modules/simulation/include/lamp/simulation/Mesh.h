#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace lamp::simulation {

/** What a surface is made of: how it reflects a lidar's light. */
enum class Material : uint8_t { kRock, kConcrete, kMetal, kReflector };

/** Triangles, counter-clockwise when seen from free space. World frame, metres. */
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
  std::vector<Material> materials;  ///< one a triangle

  void append(const Mesh& other);
  /** Unit length; zero for a degenerate triangle. */
  Eigen::Vector3f normal(size_t triangle) const;
};

}  // namespace lamp::simulation
