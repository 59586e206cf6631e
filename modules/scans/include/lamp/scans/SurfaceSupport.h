#pragma once

#include <Eigen/Core>
#include <atomic>
#include <memory>
#include <mutex>
#include <vector>

#include "lamp/scans/Cloud.h"

namespace lamp {

/** Whether a point's normal is that of a surface: the rays around the point's own ray, on most
 * sides of it, met that surface, too. A normal can also come from the pattern of the scan: fitted
 * to the outline of a corridor that one ring of a lidar draws far away, it looks along the
 * corridor; but the rays beside the ring went on.
 *
 * Only few points are asked for, but those again and again: each is computed when it is first asked
 * for. Safe to use from many threads. */
class SurfaceSupport {
 public:
  /** \param cloud, normals must outlive this; a normal is zero if unknown, and then without
   * support.
   * \param noise_m how far points lie off their surface, standard deviation.
   * \param planar the points of a level 2D laser: a ray has neighbours to its left and right only.
   */
  SurfaceSupport(const Cloud& cloud, const std::vector<Eigen::Vector3f>& normals, double noise_m,
                 bool planar);
  ~SurfaceSupport();

  bool at(size_t point) const;

  /** Memory that a point takes once support has been asked for. */
  static constexpr size_t kBytesPerPoint = 48;

 private:
  class Rays;
  enum class Answer : uint8_t { kNotAsked, kNo, kYes };

  bool computed(uint32_t point) const;

  const Cloud& cloud_;
  const std::vector<Eigen::Vector3f>& normals_;
  const double noise_m_;
  const bool planar_;
  mutable std::once_flag rays_made_;
  mutable std::vector<std::unique_ptr<const Rays>> rays_;  ///< of each viewpoint
  mutable std::vector<std::atomic<Answer>> answers_;
};

}  // namespace lamp
