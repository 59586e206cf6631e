#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

struct FeatureOptions {
  double voxel_m = 0.4;
  int normal_neighbors = 12;
  double descriptor_radius_m = 2.0;
  int max_keypoints = 1000;

  void visit(OptionVisitor& v);
};

/** Fast point feature histograms (Rusu, Blodow, Beetz, ICRA 2009) at the keypoints of a cloud. */
struct Features {
  static constexpr int kDimensions = 33;
  using Descriptors = Eigen::Matrix<float, kDimensions, Eigen::Dynamic>;

  std::vector<Eigen::Vector3f> points;   ///< in the frame of the cloud, metres
  std::vector<Eigen::Vector3f> normals;  ///< unit length, towards where the point was seen from
  Descriptors descriptors;               ///< a column a keypoint, of unit length
  double coarseness = 1;                 ///< of the cloud, see PreparedScan::coarseness()

  size_t size() const { return points.size(); }
};

/** Computed on the means of voxels, so that descriptors depend little on how densely a surface was
 * sampled. Of too many points the most distinctive ones stay: those whose descriptors differ most
 * from the cloud's mean. \param coarseness multiplies the lengths of the options. */
Features computeFeatures(const Cloud& cloud, const FeatureOptions& options, double coarseness = 1);

}  // namespace lamp
