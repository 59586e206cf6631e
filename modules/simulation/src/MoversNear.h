#pragma once

#include <optional>
#include <vector>

#include "SensorPath.h"
#include "lamp/simulation/Movers.h"

namespace lamp::simulation {

/** The movers within reach of a sensor during one sweep. */
class MoversNear {
 public:
  /** \param movers must outlive this. \param sensor world, metres. */
  MoversNear(const std::vector<Mover>& movers, const Eigen::Vector3d& sensor, double reach_m,
             double begin_stamp, double duration_s);

  /** Moves all to where they are some seconds after the begin. */
  void moveTo(double delay);

  struct Hit {
    float range_m;
    float cos_incidence;
    Material material;
  };
  /** The nearest hit within `max_range_m`. World; direction of unit length. */
  std::optional<Hit> cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                          float max_range_m) const;

 private:
  struct Near {
    const Mover* mover;
    SensorPath path;
    Eigen::Isometry3f mover_T_world = Eigen::Isometry3f::Identity();
  };
  std::vector<Near> near_;
};

}  // namespace lamp::simulation
