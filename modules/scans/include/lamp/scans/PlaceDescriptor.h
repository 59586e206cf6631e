#pragma once

#include <Eigen/Core>
#include <vector>

#include "lamp/scans/Cloud.h"

namespace lamp {

/** From a key node's frame to the level one that heads the same way; z is up in odometry's frame.
 */
Eigen::Matrix3d levelFrame(const Pose3& odom_T_base);

/** What scans show around a place, as its descriptor takes it: the first point of each voxel of 0.5
 * m, or 0.2 m in the plane, no farther than `radius_m` beside the place and above or below it.
 * \param scans their targets are the place's level frame. */
std::vector<Eigen::Vector3f> surroundings(const std::vector<PlacedScan>& scans, double radius_m,
                                          bool planar);

/** How alike two places are, and how one key node is turned against the other. */
struct PlaceMatch {
  double similarity = 0;  ///< 1 for the same surroundings; 0 if one of them is empty
  double heading = 0;     ///< yaw of the second key node in the level frame of the first, rad
};

/** What the surroundings of a key node look like from above, to recognise the place by without any
 * pose, whichever way a robot came.
 *
 * Points are counted by ring, height and azimuth, as in Scan Context (Kim, Kim, IROS 2018), and
 * each ring's counts are kept as the Fourier series of the azimuth. Turning the robot turns the
 * phases only. So magnitudes find similar places quickly, and the correlation over all headings,
 * which is one sum over the harmonics, tells how alike two are and how they are turned. */
class PlaceDescriptor {
 public:
  /** \param points around the key node, which is at the origin, in a level frame (z up), metres;
   * one for each voxel, so that a surface counts the same however densely it was seen. \param
   * radius_m what lies farther from the z axis does not count. \param planar points of a level 2D
   * laser: height does not count. */
  PlaceDescriptor(const std::vector<Eigen::Vector3f>& points, double radius_m, bool planar);

  bool planar() const { return planar_; }
  /** Independent of the heading; of unit length, or zero without points. Of two descriptors of one
   * kind the product is about what their similarity is at most. */
  const Eigen::VectorXf& magnitudes() const { return magnitudes_; }

  friend PlaceMatch match(const PlaceDescriptor& a, const PlaceDescriptor& b);

 private:
  bool planar_;
  Eigen::MatrixXcf spectrum_;  ///< a row for each ring and height, a column for each harmonic
  Eigen::VectorXf magnitudes_;
};

/** Of descriptors with one radius. A planar one is like no other one that is not. */
PlaceMatch match(const PlaceDescriptor& a, const PlaceDescriptor& b);

}  // namespace lamp
