#pragma once

#include <memory>

#include "lamp/core/Geometry.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

/** A cloud with PCL's normals and FPFH descriptors, as the paper's loop closures use them. */
class PclScan {
 public:
  /** Computes the features. */
  explicit PclScan(const Cloud& cloud);

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::shared_ptr<const Data> data_;
};

struct PclResult {
  Pose3 target_T_source = Pose3::Identity();
  /** Mean squared distances to the nearest points after each stage, metres². */
  double sac_fitness = 0, gicp_fitness = 0;
  bool converged = false;

  /** By the paper's gates. */
  bool accepted() const { return converged && sac_fitness < 32 && gicp_fitness < 0.9; }
};

/** PCL's GICP from a start; it computes the covariances of both clouds itself. */
PclResult pclGicp(const PclScan& source, const PclScan& target, const Pose3& start);

/** The paper's recipe: SAC-IA on the features, then GICP. */
PclResult pclSacIaAndGicp(const PclScan& source, const PclScan& target);

}  // namespace lamp
