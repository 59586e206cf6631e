#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "lamp/core/Geometry.h"

namespace lamp {

/** What a robot has seen lately, for registering its next scan: points in one frame, thinned, with
 * the plane (of a level 2D laser: the line) through each point and its neighbours. Grows scan by
 * scan; a scan costs what is near it, not what the map holds. */
class LocalMap {
 public:
  /** The surface around a point. */
  struct Surface {
    Eigen::Vector3f center = Eigen::Vector3f::Zero();  ///< metres
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit length, towards the lidar
    float deviation_m = 0;                             ///< of the points across it, standard
  };

  /** \param leaf_m points lie at least this far apart, metres.
   *  \param planar the points of a level 2D laser. */
  LocalMap(double leaf_m, bool planar);

  /** Adds points where there is none yet: what was seen first is what later scans are held
   * against, so that they do not drag the map along.
   *  \param points in a frame whose pose is `map_T_points`, metres.
   *  \param origin where they were seen from, in that frame.
   *  \param travelled_m how far the robot has come, see forget(). */
  void add(const std::vector<Eigen::Vector3f>& points, const Pose3& map_T_points,
           const Eigen::Vector3f& origin, double travelled_m);
  /** Drops what was last seen before the robot had come so far, or lies farther from it. */
  void forget(double travelled_m, const Eigen::Vector3f& robot, double radius_m);

  /** \return the surface at the point nearest to the query; none if there is no point within
   * `max_distance_m`, or its neighbours show no surface. The reference holds until add(). */
  const Surface* surfaceNear(const Eigen::Vector3f& query, float max_distance_m);

  size_t size() const { return points_; }
  double leaf() const { return leaf_m_; }
  bool planar() const { return planar_; }
  /** Mean over the surfaces fitted lately of how far their points lie off them: the lidar's noise,
   * and the surfaces' roughness. Metres, standard deviation. */
  double deviation() const { return deviation_m_; }
  /** All points, by block, in the order of the blocks' first points: for pictures and tests. */
  std::vector<Eigen::Vector3f> points() const;

 private:
  struct MapPoint {
    Eigen::Vector3f position;
    Eigen::Vector3f origin;  ///< seen from there
    uint32_t fitted_at = 0;  ///< number of the fit's map, see revision_
    Surface surface;
  };
  struct Block {
    std::vector<MapPoint> points;
    double seen_m = 0;  ///< how far the robot had come when it was last seen
    uint32_t changed_at = 0;
    uint64_t order = 0;
  };

  uint64_t keyOf(const Eigen::Vector3f& point) const;
  template <class Visit>
  void visitNear(const Eigen::Vector3f& center, float radius, Visit&& visit);
  MapPoint* nearest(const Eigen::Vector3f& query, float max_distance_m, uint32_t& changed_at);
  bool isFree(const Block& block, const Eigen::Vector3f& point) const;
  void fit(MapPoint& point);
  bool fitWithin(float radius, MapPoint& point);

  const double leaf_m_;
  const bool planar_;
  const float block_m_;
  std::unordered_map<uint64_t, Block> blocks_;
  size_t points_ = 0;
  double deviation_m_ = 0;
  uint32_t revision_ = 0;
  uint64_t next_order_ = 0;
  std::vector<Eigen::Vector3f> neighbors_;  ///< of the fit under way
};

}  // namespace lamp
