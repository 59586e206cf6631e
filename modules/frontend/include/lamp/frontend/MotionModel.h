#pragma once

#include "lamp/core/Geometry.h"
#include "lamp/core/Options.h"

namespace lamp {

struct MotionModelOptions {
  double sigma_m_per_m = 0.02;
  double sigma_rad_per_m = 0.003;
  double sigma_rad_per_rad = 0.02;
  double min_sigma_m = 0.003;
  double min_sigma_rad = 0.0025;

  void visit(OptionVisitor& v);
};

/** What a robot went through between two key nodes. */
struct Path {
  double length_m = 0;
  double turned_rad = 0;

  void add(const Pose3& motion);
};

/** Covariance of odometry over a path: grows with the way and the turning, and is never below the
 * fixed values of LAMP for an edge. */
Matrix6d odometryCovariance(const Path& path, const MotionModelOptions& options);

/** Covariance of odometry between two scans, so that those of an edge's steps add up to about the
 * edge's: errors persist over metres, so each step has its share of the edge's variance. */
Matrix6d stepCovariance(const Pose3& motion, const MotionModelOptions& options);

}  // namespace lamp
