#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/Options.h"

namespace lamp {

/** The ini's section `[gate]`: three reflective plates of known position, in front of which robots
 * stand at the start (paper II-A). */
struct GateOptions {
  std::vector<double> plates;  ///< x y z of the middle of each in the world
  double plate_m = 0.3;
  double intensity_ratio = 2.0;
  double standing_s = 3.0;
  double up_sigma_deg = 0.2;

  void visit(OptionVisitor& v);
  std::vector<Eigen::Vector3d> positions() const;
  void moveBy(const Eigen::Vector3d& shift);
};

/** Why no pose can follow from these plates, whatever is seen of them; none if one can. */
std::optional<std::string> faultOf(const GateOptions& gate);

/** A ray of a lidar that came back, in the base frame of a robot at rest; metres. */
struct LidarRay {
  Eigen::Vector3f origin, point;
  float intensity = 0;

  float range() const { return (point - origin).norm(); }
};

/** Where a robot stands, or why nobody knows. */
struct GateResult {
  std::optional<StartPrior> pose;
  std::string reason;
};

/** Finds the pose of a robot that stands before the gate (paper II-A), by all that its lidars have
 * seen meanwhile.
 *
 * What shines is clustered; of all triples of clusters in all orders, those that fit the plates'
 * triangle are tried. The middle of each plate follows from which rays hit it and which pass it by:
 * a lidar with few beams, which at rest draws the same few lines again and again, sees a part of a
 * plate whose centroid may lie far from the middle. The pose is that of least squares, with gravity
 * where an inertial unit has felt it. */
class GateCalibration {
 public:
  explicit GateCalibration(const GateOptions& options) : options_(options) {}

  /** \param scan in the base frame; scans without intensity are ignored. */
  void add(const Scan& scan);
  /** \param specific_force of an inertial unit, base frame, m/s². */
  void addForce(const Eigen::Vector3d& specific_force) { force_ += specific_force; }

  GateResult solve() const;

 private:
  GateOptions options_;
  std::map<std::string, std::vector<LidarRay>>
      rays_;  ///< by lidar, as each has an intensity of its own
  size_t ray_count_ = 0;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();
};

}  // namespace lamp
