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
  double translation_tolerance_m = 1e-3;
  double rotation_tolerance_deg = 0.05;

  void visit(OptionVisitor& v);
};

struct IcpResult {
  Pose3 target_T_source = Pose3::Identity();
  /** Sum of Hᵀ H over the matched points, H the derivative of the point-to-plane distance (metres)
   * by the tangent vector at target_T_source; the A of the paper's observability analysis. */
  Matrix6d information = Matrix6d::Zero();
  bool converged = false;  ///< false also if too few points matched
  int iterations = 0;
  size_t matches = 0;  ///< in the last iteration
};

/** Aligns source to target by Gauss-Newton from a start pose. Matches are searched within a
 * distance that shrinks from iteration to iteration; a Geman-McClure kernel takes the weight from
 * the bad ones. Planar scans are aligned in x, y and yaw only, the other coordinates keep the
 * start's. */
IcpResult icp(const PreparedScan& source, const PreparedScan& target, const Pose3& start,
              IcpMetric metric, const IcpOptions& options);

/** How well two scans agree at a relative pose. */
struct Agreement {
  double overlap = 0;     ///< share of source points with a partner of like normal
  double residual_m = 0;  ///< r.m.s. point-to-plane distance of those
  size_t matches = 0;
};

/** \param distance_m how near a partner must be; its normal must agree within 45°. */
Agreement agreement(const PreparedScan& source, const PreparedScan& target,
                    const Pose3& target_T_source, double distance_m);

}  // namespace lamp
