#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "lamp/core/KdTree.h"

namespace lamp::evaluation {

/** Samples of the true surface, about 0.1 m apart. Their frame has the axes of the world. */
struct SurfaceSamples {
  std::vector<Eigen::Vector3f> points;   ///< metres
  std::vector<Eigen::Vector3f> normals;  ///< unit length, into free space
  std::vector<uint8_t> seen;             ///< 1 if any scan of the recording saw the sample
  /** World coordinates of the samples' origin, metres: what is this far from the world's origin has
   * no place in single precision. Zero within a kilometre. */
  Eigen::Vector3d world_p_origin = Eigen::Vector3d::Zero();

  /** Reads `x y z nx ny nz` and, where there is one, `seen` of a PLY file; without it all count as
   * seen. 25 bytes a sample. \throws std::runtime_error if the file is malformed or empty, or no
   * sample was seen. */
  static SurfaceSamples fromPly(const std::string& path);
};

/** The samples and their search tree. */
class TrueSurface {
 public:
  explicit TrueSurface(SurfaceSamples samples)
      : samples_(std::move(samples)), tree_(samples_.points) {}
  TrueSurface(const TrueSurface&) = delete;  // the tree refers to the points
  TrueSurface& operator=(const TrueSurface&) = delete;

  const SurfaceSamples& samples() const { return samples_; }
  /** Distance of a point to the plane through the nearest sample, metres. A point further than
   * 0.2 m from that sample along the plane lies beyond the surface's edge: then the distance to the
   * sample, so that a plane does not reach further than its surface. */
  float distance(const Eigen::Vector3f& point) const;

 private:
  const SurfaceSamples samples_;
  const KdTree tree_;
};

}  // namespace lamp::evaluation
