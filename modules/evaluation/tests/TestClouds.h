#pragma once

#include <string>
#include <vector>

#include "lamp/core/Files.h"
#include "lamp/evaluation/TrueSurface.h"

namespace lamp::test {

using namespace evaluation;

/** Samples in the middle of 0.1 m squares of a level rectangle; the normal points up or down. */
inline void addLevel(float x0, float x1, float y0, float y1, float z, float up,
                     SurfaceSamples& samples) {
  for (float x = x0 + 0.05f; x < x1; x += 0.1f)
    for (float y = y0 + 0.05f; y < y1; y += 0.1f) {
      samples.points.emplace_back(x, y, z);
      samples.normals.emplace_back(0.0f, 0.0f, up);
      samples.seen.push_back(1);
    }
}

/** The same for an upright rectangle with x or y constant. */
inline void addWall(bool at_x, float at, float from, float to, float z0, float z1,
                    SurfaceSamples& samples) {
  for (float along = from + 0.05f; along < to; along += 0.1f)
    for (float z = z0 + 0.05f; z < z1; z += 0.1f) {
      samples.points.push_back(at_x ? Eigen::Vector3f(at, along, z)
                                    : Eigen::Vector3f(along, at, z));
      samples.normals.push_back(at_x ? Eigen::Vector3f(1, 0, 0) : Eigen::Vector3f(0, 1, 0));
      samples.seen.push_back(1);
    }
}

/** A closed box from the origin to `size`. Surfaces lie in the middle of voxels of 0.2 m. */
inline SurfaceSamples box(const Eigen::Vector3f& size) {
  constexpr float kIn = 0.1f;
  const float x = size.x() - kIn, y = size.y() - kIn, z = size.z() - kIn;
  SurfaceSamples samples;
  addLevel(0, size.x(), 0, size.y(), kIn, 1, samples);
  addLevel(0, size.x(), 0, size.y(), z, -1, samples);
  addWall(true, kIn, 0, size.y(), 0, size.z(), samples);
  addWall(true, x, 0, size.y(), 0, size.z(), samples);
  addWall(false, kIn, 0, size.x(), 0, size.z(), samples);
  addWall(false, y, 0, size.x(), 0, size.z(), samples);
  return samples;
}

/** An ASCII PLY of points. */
inline void writePly(const std::string& path, const std::vector<Eigen::Vector3f>& points) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(points.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  for (const auto& p : points)
    text +=
        std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  writeTextFile(path, text);
}

}  // namespace lamp::test
