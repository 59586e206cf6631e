#pragma once

#include <Eigen/Core>

#include "lamp/core/VoxelSet.h"

namespace lamp {

/** How many pieces of surface, about a metre wide, points lie on. What is wrong with a point is
 * wrong with its neighbours, so it is these that count as measurements. */
class PatchCount {
 public:
  void add(const Eigen::Vector3f& point) {
    // Patches lie about whole metres.
    patches_.insert(point.cast<double>() + Eigen::Vector3d::Constant(0.5 * kPatch_m));
  }
  double count() const { return static_cast<double>(patches_.size()); }

 private:
  static constexpr double kPatch_m = 1.0;
  VoxelSet patches_{kPatch_m};
};

}  // namespace lamp
