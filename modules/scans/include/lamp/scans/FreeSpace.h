#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "lamp/scans/Cloud.h"

namespace lamp {

/** What the rays of a cloud say of the space before its points: for each place that it was seen
 * from, a range image. */
class FreeSpace {
 public:
  FreeSpace() = default;
  explicit FreeSpace(const Cloud& cloud);

  enum class Place {
    kUnknown,  ///< no ray went this way, or the place lies behind what it hit
    kSurface,  ///< near what the rays hit
    kFree,     ///< rays went through
  };
  /** \param point in the cloud's frame; \param margin_m how far from a surface, along the ray, is
   * still on it; it widens with range, since rays meet far surfaces at a slant. */
  Place at(const Eigen::Vector3f& point, float margin_m) const;

  size_t bytes() const;

 private:
  /** Least range in each direction, over an octahedron's faces unfolded to a square; 0 where no ray
   * went. `near` is the least over the neighbours, too: a slanted surface passes from one to the
   * next. */
  struct View {
    Eigen::Vector3f position;
    std::vector<float> near, far;
  };
  std::vector<View> views_;
};

}  // namespace lamp
