#pragma once

#include <Eigen/Core>
#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lamp/core/KdTree.h"
#include "lamp/scans/Cloud.h"
#include "lamp/scans/Features.h"
#include "lamp/scans/FreeSpace.h"
#include "lamp/scans/PlanarAlignment.h"
#include "lamp/scans/SurfaceSupport.h"

namespace lamp {

struct ScanPreparationOptions {
  int normal_neighbors = 10;
  FeatureOptions features;

  void visit(OptionVisitor& v);
};

/** A scan for registration, perhaps with its neighbours', with all that is computed from it once:
 * search tree, normals, the free space before it, keypoints with descriptors. Safe to use from many
 * threads.
 *
 * The covariance of a point in generalised ICP follows from its normal alone (Segal, Haehnel,
 * Thrun, RSS 2009): one along the surface, almost none across it. So normals are all that is
 * stored.
 */
class PreparedScan {
 public:
  /** Points that are not finite, or farther than 1000 km, are left out. The others are put in an
   * order in which neighbours follow one another: searches for them then share the cache.
   * \param planar points of a level 2D laser: normals are lines' normals in the x-y plane, and
   * there are no features. */
  PreparedScan(const Cloud& cloud, const ScanPreparationOptions& options, bool planar);
  PreparedScan(const PreparedScan&) = delete;  // the tree refers to the points
  PreparedScan& operator=(const PreparedScan&) = delete;

  size_t size() const { return cloud_.size(); }
  /** Places of the scan's own points among all: as a source only these are used, as a target the
   * neighbours' points, too. */
  const std::vector<uint32_t>& own() const { return own_; }
  bool isOwn(size_t i) const { return cloud_.isOwn(i); }
  /** In the frame of the key node, metres. */
  const std::vector<Eigen::Vector3f>& points() const { return cloud_.points; }
  /** Unit length, towards the lidar that saw the point; zero where the surface is unknown. */
  const std::vector<Eigen::Vector3f>& normals() const { return normals_; }
  bool planar() const { return planar_; }
  const KdTree& tree() const { return tree_; }
  const FreeSpace& freeSpace() const { return free_space_; }
  /** Of its own points; the origin and zero if it has none. Metres. */
  const Eigen::Vector3d& centroid() const { return centroid_; }
  /** R.m.s. distance of its own points from the centroid, metres. */
  double radius() const { return radius_m_; }
  /** How far its points lie off their surface, median of the standard deviations around each,
   * metres: the lidar's noise, and the surface's roughness. */
  double noise() const { return noise_m_; }
  /** Whether a point's normal is a surface's, see SurfaceSupport. */
  bool isOnSurface(size_t i) const { return support_->at(i); }
  /** Computed when first asked for: not every aligner needs them. */
  const Features& features() const;
  /** Of a planar scan, computed when first asked for. */
  const OccupancyPyramid& occupancy() const;
  /** How much farther apart its points lie than those of the scans that lengths among the options
   * of registration were chosen for; 1 for denser scans. Such lengths grow with it. */
  double coarseness() const { return coarseness_; }
  /** Memory, with all that is computed when it is asked for. */
  size_t bytes() const;
  /** Time spent on all of it so far, but for isOnSurface(). */
  double secondsOfPreparation() const { return seconds_; }

 private:
  const std::chrono::steady_clock::time_point begun_;
  const FeatureOptions feature_options_;
  const bool planar_;
  const Cloud cloud_;
  const KdTree tree_;
  std::vector<Eigen::Vector3f> normals_;
  std::vector<uint32_t> own_;
  const FreeSpace free_space_;
  const double coarseness_;
  Eigen::Vector3d centroid_ = Eigen::Vector3d::Zero();
  double radius_m_ = 0, noise_m_ = 0;
  std::unique_ptr<const SurfaceSupport> support_;
  mutable std::once_flag features_made_;
  mutable Features features_;
  mutable std::once_flag occupancy_made_;
  mutable std::optional<OccupancyPyramid> occupancy_;
  mutable std::atomic<double> seconds_{0};
};
using PreparedScanPtr = std::shared_ptr<const PreparedScan>;

/** That of the coarser of the two. */
double coarseness(const PreparedScan& a, const PreparedScan& b);

/** Points in a frame at whose origin the lidar stood. */
PreparedScanPtr prepareScan(std::vector<Eigen::Vector3f> points, int normal_neighbors, bool planar);

}  // namespace lamp
