#pragma once

#include <string>

#include "lamp/simulation/FreeSpace.h"
#include "lamp/simulation/Random.h"
#include "lamp/simulation/Solids.h"
#include "lamp/simulation/World.h"

namespace lamp::simulation {

/** Cross-section and walls of a passage. */
struct PassageStyle {
  double width_m, height_m, corner_m;
  WallStyle wall;
};

/** Puts a world together: passages that are hollows and ways at once, rooms, and what stands in
 * them. Things are never put where robots drive. */
class WorldBuilder {
 public:
  explicit WorldBuilder(uint64_t seed)
      : space_(mixSeeds({seed, 1})), random_(mixSeeds({seed, 2})) {}

  Random& random() { return random_; }
  const Layout& layout() const { return world_.layout; }

  size_t addPlace(const Eigen::Vector3d& floor);
  /** A passage through `between` on the way from one place to the other. */
  size_t addPassage(size_t from, size_t to, const PassageStyle& style,
                    const std::vector<Eigen::Vector3d>& between = {});
  /** A room of `size` (along, across, up) around a place, turned by `yaw`. */
  void addRoom(const Eigen::Vector3d& floor, const Eigen::Vector3d& size, double yaw,
               const WallStyle& wall);
  void addPillar(const Pillar& pillar) { space_.add(pillar); }
  void addSolid(const Mesh& solid);
  void addLookAlikes(std::vector<Eigen::Vector3d> spots);

  /** Boulders, about one every `spacing_m`, along the foot of a passage's walls. */
  void addRubble(size_t passage, double spacing_m, double largest_m);
  /** A pipe along a passage's wall, `height_m` above the floor, held by rings; `side` is 1 for
   * left, -1 for right. */
  void addPipe(size_t passage, double height_m, double radius_m, int side);
  /** Props of timber or steel across a passage, every `spacing_m`: posts and a cap. */
  void addSupports(size_t passage, double spacing_m);
  /** A frame that narrows a passage to a door at `share` of its length; so wide is the passage
   * then for those who drive it. */
  void addDoorFrame(size_t passage, double share, double width_m, double height_m);
  /** Crates and cabinets at random spots around a floor point, as far as `reach_m`. */
  void addClutter(const Eigen::Vector3d& floor, double reach_m, int count, Random& random);
  /** Reflective signs on the walls that are not the gate's plates. */
  void addDistractors(int count);
  /** The gate: a frame with three reflective plates of known position in the passage that leaves
   * the layout's gate, and room for robots in front of it. */
  void addGate();
  /** Artifacts beside passages, away from the gate. */
  void addArtifacts(int count);

  /** Makes the walls. The builder is used up. */
  World build(double cell_m);

 private:
  const PassageStyle& styleOf(size_t passage) const { return styles_[passage]; }
  /** A point of a passage's middle, and the direction there. */
  Pose3 alongPassage(size_t passage, double share) const;
  bool isDriven(const Eigen::Vector3d& p, double clearance_m) const;
  /** Where robots may cut the corner from one passage into another. */
  bool isAtCorner(const Eigen::Vector3d& p, double clearance_m) const;
  /** In free space, and in none of the things that were added. */
  bool isFree(const Eigen::Vector3d& p, double clearance_m) const;

  World world_;
  FreeSpace space_;
  Random random_;
  std::vector<PassageStyle> styles_;         ///< of layout().passages
  std::vector<Eigen::AlignedBox3d> solids_;  ///< boxes around what was added
};

}  // namespace lamp::simulation
