#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/scans/LocalMap.h"

namespace lamp {

/** Where a robot is in a surveyed map, scan by scan, for reference trajectories (paper III-B):
 * odometry predicts, and the scan is registered to the survey. Directions that the surroundings
 * leave free, as the axis of a tunnel, take their motion from odometry. */
class SurveyLocalizer {
 public:
  /** \param survey outlives this. \param start of the first scan: where to look for it. The pose is
   * sought around it even if its covariance is smaller than such poses deserve. */
  SurveyLocalizer(LocalMap& survey, const StartPrior& start);

  /** The robot moves on. */
  void predict(const OdometryEdge& motion);
  /** Registers the scan that was taken at pose(), and corrects the pose by it.
   * \param points base frame, metres.
   * \return false if too little of the scan lies on the survey's surfaces, or it says something
   *    else than odometry does: then the pose is the predicted one. A survey that goes on to
   *    contradict odometry is believed. */
  bool correct(const std::vector<Eigen::Vector3f>& points);

  /** `survey_T_base`. */
  const Pose3& pose() const { return pose_; }
  /** Of the last scan that was registered: share of the points on surfaces of the survey, and
   * how far these lie off, robust standard deviation, metres. */
  double matchedShare() const { return matched_share_; }
  double deviation() const { return deviation_m_; }
  /** Whether its surfaces hold it in all directions. */
  bool observed() const { return observed_; }

 private:
  LocalMap& survey_;
  Pose3 pose_;
  Matrix6d covariance_;  ///< in the tangent space at the pose
  double matched_share_ = 0, deviation_m_ = 0;
  bool observed_ = false;
};

}  // namespace lamp
