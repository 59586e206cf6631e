#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "lamp/simulation/Mesh.h"

namespace lamp::simulation {

/** Where a ray meets the world. */
struct RayHit {
  float range_m = 0;
  uint32_t triangle = 0;  ///< of the mesh
};

/** First hits of rays on a mesh (Embree). Safe to use from many threads. */
class RayCaster {
 public:
  /** \param mesh must outlive the caster and stay as it is. */
  explicit RayCaster(const Mesh& mesh);
  ~RayCaster();

  const Mesh& mesh() const { return mesh_; }
  /** \param direction of unit length. \return none if nothing is hit within `max_range_m`. */
  std::optional<RayHit> cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                             float max_range_m) const;
  /** Whether the straight line between two points is free, but for the last 5 cm at each end. */
  bool visible(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;

 private:
  struct Scene;
  const Mesh& mesh_;
  std::unique_ptr<Scene> scene_;
};

}  // namespace lamp::simulation
