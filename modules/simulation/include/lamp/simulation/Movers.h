#pragma once

#include <optional>
#include <vector>

#include "lamp/core/Options.h"
#include "lamp/core/Trajectory.h"
#include "lamp/simulation/Layout.h"
#include "lamp/simulation/Mesh.h"
#include "lamp/simulation/RayCaster.h"

namespace lamp::simulation {

struct MoverOptions {
  int people = 0;
  int vehicles = 0;
  double person_speed_mps = 1.3;
  double vehicle_speed_mps = 3.0;
  double stop_share = 0.3;
  double stop_s = 10;

  void visit(OptionVisitor& v);
};

/** A person or a vehicle that goes about in a world: a box that stands on the floor. */
struct Mover {
  Eigen::Vector3f size;  ///< along x (forward), y and z, metres
  Material material = Material::kConcrete;
  TrajectoryInterpolator world_T_mover;  ///< in the middle of its base, x forward

  /** \param origin, direction in the mover's frame; the latter of unit length.
   *  \return the distance at which a ray enters the box, and the face's normal; none if it misses
   *    it or starts within. */
  struct Hit {
    float range_m;
    Eigen::Vector3f normal;
  };
  std::optional<Hit> cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
};

struct TimeSpan {
  double begin = 0, end = 0;  ///< seconds, UTC
};

/** People and vehicles that wander from place to place on the right of the passages, and stop at
 * some. They pass through each other and through robots. \param world its floor carries them. */
std::vector<Mover> makeMovers(const MoverOptions& options, const Layout& layout,
                              const RayCaster& world, const TimeSpan& time, uint64_t seed);

}  // namespace lamp::simulation
