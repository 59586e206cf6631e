#pragma once

#include "lamp/core/Geometry.h"
#include "lamp/core/Options.h"
#include "lamp/scans/PreparedScan.h"

namespace lamp {

/** How the distance between two matched points is measured. */
enum class IcpMetric {
  kPlaneToPlane,  ///< generalised ICP (Segal, Haehnel, Thrun, RSS 2009)
  kPointToPlane,  ///< distance along the target's normal (Chen, Medioni 1991)
};

struct IcpOptions {
  int max_iterations = 40;
  double start_correspondence_m = 2.0;
  double correspondence_m = 0.5;
  double shrink_factor = 0.7;
  double kernel_m = 0.2;
  double plane_thickness = 0.01;
  double translation_tolerance_m = 1e-3;
  double rotation_tolerance_deg = 0.05;

  void visit(OptionVisitor& v);
};

struct IcpResult {
  Pose3 target_T_source = Pose3::Identity();
  bool converged = false;  ///< false also if too few points matched
  int iterations = 0;
  size_t matches = 0;  ///< in the last iteration
};

/** Aligns source to target by Gauss-Newton from a start pose. Matches are searched within a
 * distance that shrinks from iteration to iteration; a Geman-McClure kernel takes the weight from
 * the bad ones. The first iterations look at a part of the source's points. Planar scans are
 * aligned in x, y and yaw only, the other coordinates keep the start's. Lengths of the
 * options grow with the coarseness of the scans. */
IcpResult icp(const PreparedScan& source, const PreparedScan& target, const Pose3& start,
              IcpMetric metric, const IcpOptions& options);

}  // namespace lamp
