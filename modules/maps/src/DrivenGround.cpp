#include "DrivenGround.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Vector3d;

/** Ground is looked for so far above and below the base, metres: bases lie at most as high as a
 * robot, or slightly in the ground. */
constexpr double kAboveBase = 0.4, kBelowBase = 2.0;
/** So far from the plane that the robot stood on the ground may be uneven, metres. */
constexpr double kUneven = 0.3;
/** Ground is taken to be at least this thick, voxels, and, where it was seen, to reach so far
 * around the body, metres: poses are not exact, and the true ground shall be known. */
constexpr int kThickness = 3;
constexpr double kAround = 0.8;
/** Poses nearer to each other than this many voxels say the same. */
constexpr double kSameVoxels = 0.5;

/** Voxels of heights, looked up in one column. */
class Column {
 public:
  Column(const VoxelSetBlocks& occupied, int x, int y) : occupied_(occupied), x_(x), y_(y) {}

  VoxelIndex at(int z) const { return {x_, y_, z}; }
  /** The highest occupied voxel within the range, searched downwards. */
  std::optional<int> highest(int top, int bottom) const {
    for (int z = top; z >= bottom; --z)
      if (occupied_.test(at(z))) return z;
    return std::nullopt;
  }

 private:
  const VoxelSetBlocks& occupied_;
  int x_, y_;
};

int floorOf(double value) {
  return static_cast<int>(std::floor(value));
}

/** Poses of a track about half a voxel apart. */
std::vector<StampedPose> thinned(const MapTrack& track, double resolution_m) {
  std::vector<StampedPose> poses;
  for (const StampedPose& pose : track.poses)
    if (poses.empty() || (pose.pose.translation() - poses.back().pose.translation()).norm() >=
                             kSameVoxels * resolution_m)
      poses.push_back(pose);
  return poses;
}

void set(const VoxelIndex& voxel, VoxelSetBlocks& set) {
  if (isInGrid(voxel)) set[blockOf(voxel)].set(placeInBlock(voxel));
}

/** Stamps one robot's body. */
class Stamp {
 public:
  Stamp(const VoxelSetBlocks& occupied, const RobotBody& body, double height_above_ground,
        double resolution_m, DrivenGround& driven)
      : occupied_(occupied),
        body_(body),
        above_ground_(height_above_ground),
        voxel_m_(resolution_m),
        body_voxels_(voxelsIn(body.height_m, resolution_m)),
        driven_(driven) {}

  void at(const StampedPose& pose) {
    const Pose3& world_T_base = pose.pose;
    const Vector3d up = world_T_base.linear().col(2),
                   foot = world_T_base.translation() - above_ground_ * up;
    const double radius = body_.radius_m + kAround;
    const int reach = floorOf(radius / voxel_m_) + 1;
    const VoxelIndex center = voxelAt(foot / voxel_m_);
    for (int x = center.x() - reach; x <= center.x() + reach; ++x)
      for (int y = center.y() - reach; y <= center.y() + reach; ++y) {
        const Eigen::Vector2d beside((x + 0.5) * voxel_m_ - foot.x(),
                                     (y + 0.5) * voxel_m_ - foot.y());
        if (beside.norm() > radius) continue;
        constexpr double kUpright = 0.5;  // steeper robots lie
        const double slope = up.z() < kUpright ? 0 : -up.head<2>().dot(beside) / up.z();
        column(Column(occupied_, x, y), foot.z() + slope, beside.norm(), pose.stamp);
      }
  }

 private:
  void column(const Column& column, double ground_m, double beside_m, double stamp) {
    const bool under_body = beside_m <= body_.radius_m;
    const auto seen = column.highest(floorOf((ground_m + kUneven) / voxel_m_),
                                     floorOf((ground_m - kUneven) / voxel_m_));
    if (!seen && !under_body) return;
    const int top = seen.value_or(floorOf(ground_m / voxel_m_));
    for (int z = top; z > top - kThickness; --z) set(column.at(z), driven_.ground);
    if (!under_body) return;
    if (isInGrid(column.at(top))) driven_.floor.push_back(column.at(top));
    for (int z = top + 1; z <= top + body_voxels_; ++z)
      enter(column.at(z), beside_m <= body_.radius_m / 2, stamp);
  }

  void enter(const VoxelIndex& voxel, bool by_its_middle, double stamp) {
    if (!isInGrid(voxel)) return;
    set(voxel, driven_.entered);
    if (!by_its_middle) return;
    double& last = driven_.crossed.try_emplace(voxelKey(voxel), stamp).first->second;
    last = std::max(last, stamp);
  }

  const VoxelSetBlocks& occupied_;
  const RobotBody body_;
  const double above_ground_, voxel_m_;
  const int body_voxels_;
  DrivenGround& driven_;
};

}  // namespace

std::optional<double> heightAboveGround(const MapTrack& track, const VoxelSetBlocks& occupied,
                                        double resolution_m) {
  std::vector<double> heights;
  const std::vector<StampedPose> poses = thinned(track, resolution_m);
  for (const StampedPose& pose : poses) {
    const Vector3d base = pose.pose.translation() / resolution_m;
    const VoxelIndex voxel = voxelAt(base);
    const auto found = Column(occupied, voxel.x(), voxel.y())
                           .highest(floorOf(base.z() + kAboveBase / resolution_m),
                                    floorOf(base.z() - kBelowBase / resolution_m));
    // The surface is somewhere in the voxel: on average in its middle.
    if (found) heights.push_back((base.z() - *found - 0.5) * resolution_m);
  }
  if (heights.empty() || 2 * heights.size() < poses.size()) return std::nullopt;
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  return *middle;
}

DrivenGround drivenGround(const std::vector<MapTrack>& tracks, const VoxelSetBlocks& occupied,
                          const RobotBody& body, double resolution_m) {
  DrivenGround driven;
  for (const MapTrack& track : tracks) {
    const auto height = heightAboveGround(track, occupied, resolution_m);
    if (!height) continue;
    Stamp stamp(occupied, body, *height, resolution_m, driven);
    for (const StampedPose& pose : thinned(track, resolution_m)) stamp.at(pose);
  }
  return driven;
}

}  // namespace lamp
