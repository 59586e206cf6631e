#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "lamp/simulation/Mesh.h"
#include "lamp/simulation/Noise.h"

namespace lamp::simulation {

/** How the walls around a hollow look. */
struct WallStyle {
  double roughness_m = 0;  ///< height of the rock's bumps, 1.5 m apart and less
  double waviness_m = 0;   ///< slow change of width and height, over about 12 m
  double floor_share = 1;  ///< how much of both the floor has
  double blend_m = 0;      ///< how far around a corner two such hollows flow into one another
  Material material = Material::kConcrete;
};

/** A straight hollow with a flat floor, possibly sloped: drive, corridor, or (short and wide) room.
 * Cross-section: a rectangle with rounded corners. World frame, metres. */
struct Hollow {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< middle of the floor at one end
  Eigen::Vector3d to = Eigen::Vector3d::Zero();    ///< ... at the other end
  double width_m = 3;
  double height_m = 3;
  double corner_m = 0.3;  ///< radius of the corners
  double level_m = 0;     ///< by how much the hollow goes on, level, beyond both ends
  WallStyle style;
};

/** Rock that stands in the hollows: a vertical pillar from floor to roof. */
struct Pillar {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  double radius_m = 0.5;
  double height_m = 10;
  bool square = false;
};

/** A world as the union of hollows in solid rock, less the pillars, as a signed distance. */
class FreeSpace {
 public:
  explicit FreeSpace(uint64_t seed) : noise_(seed) {}

  void add(const Hollow& hollow);
  void add(const Pillar& pillar);

  const std::vector<Hollow>& hollows() const { return hollows_; }
  /** The box that holds all hollows and their roughness. */
  Eigen::AlignedBox3d bounds() const;

  /** The hollows and pillars that matter in some box. */
  struct Parts {
    std::vector<size_t> hollows, pillars;
  };
  Parts partsIn(const Eigen::AlignedBox3d& box) const;

  struct Sample {
    double distance_m;  ///< negative in free space
    size_t hollow;      ///< the one that is nearest
  };
  /** Distance from the walls without their roughness, correct near walls and a bound elsewhere.
   *  \param parts must hold a hollow. */
  Sample smooth(const Eigen::Vector3d& p, const Parts& parts) const;
  /** The same with roughness. */
  double rough(const Eigen::Vector3d& p, const Sample& sample) const;
  /** By how much roughness can move a wall, metres. */
  double roughness() const { return roughness_m_; }

 private:
  /** A hollow's axis in the plan. */
  struct Axis {
    Eigen::Vector2d direction;
    double length;
  };
  /** Coordinates of a point in a hollow: along from its middle, across, above the floor. */
  Eigen::Vector3d localOf(size_t hollow, const Eigen::Vector3d& p) const;
  /** Floors are trodden flatter than walls, and do not flow into one another: 0 up to the floor, 1
   * from 0.6 m above it. */
  double aboveFloor(size_t hollow, const Eigen::Vector3d& p) const;
  double distanceTo(size_t hollow, const Eigen::Vector3d& p) const;

  Noise noise_;
  std::vector<Hollow> hollows_;
  std::vector<Axis> axes_;
  std::vector<Eigen::AlignedBox3d> boxes_;
  std::vector<Pillar> pillars_;
  double roughness_m_ = 0;
};

}  // namespace lamp::simulation
