#include "ScanRays.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <vector>

namespace lamp {

namespace {

using Eigen::Vector3d;

/** A ray that only cuts a voxel's corner, for less than this share of its edge, says little. */
constexpr double kLeastWay = 0.25;
/** Distance across the surface within which a ray is no witness, voxels. */
constexpr double kAcross = 1.0;
/** Where the incidence is unknown, the share of the range before the end in which a ray is no
 * witness: enough for a sensor two voxels from the surface, however grazing the ray. */
constexpr double kUnknownShare = 0.5;
/** Below this the plane through the points is rather that of the rays themselves, as of one laser
 * of a lidar, than a surface. */
constexpr double kLeastSine = 0.02;

/** Of points, what the plane through them follows from; in voxels. */
struct Moments {
  int count = 0;
  Vector3d sum = Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();

  void add(const Vector3d& p) {
    ++count;
    sum += p;
    squares.noalias() += p * p.transpose();
  }
  void add(const Moments& other) {
    count += other.count;
    sum += other.sum;
    squares += other.squares;
  }
  /** Unit length; zero if the points show no plane. */
  Vector3d normal() const {
    constexpr int kFewest = 8;
    constexpr double kFlat = 4.0, kLong = 0.01;
    if (count < kFewest) return Vector3d::Zero();
    const Vector3d mean = sum / count;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(squares / count - mean * mean.transpose());
    const Vector3d values = eigen.eigenvalues();
    const bool flat = values[1] > kFlat * values[0] && values[1] > kLong * values[2];
    return flat ? Vector3d(eigen.eigenvectors().col(0)) : Vector3d::Zero();
  }
};

/** The normals of the surfaces that a scan hit, one for each block. */
class SurfaceNormals {
 public:
  void add(BlockKey block, const Vector3d& point) { moments_[block].add(point); }
  /** Where a block's points show no plane, since they are few or on a line, those around help. */
  void fit() {
    for (const auto& [block, moments] : moments_) {
      Vector3d normal = moments.normal();
      if (normal.isZero()) normal = momentsAround(block).normal();
      normals_[block] = normal;
    }
  }
  /** Zero if unknown. */
  const Vector3d& at(BlockKey block) const { return normals_.at(block); }

 private:
  Moments momentsAround(BlockKey block) const {
    Moments sum;
    const VoxelIndex first = firstVoxelOf(block);
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const VoxelIndex corner = first + kBlockSide * VoxelIndex(x, y, z);
          if (!isInGrid(corner)) continue;
          const auto found = moments_.find(blockOf(corner));
          if (found != moments_.end()) sum.add(found->second);
        }
    return sum;
  }

  std::unordered_map<BlockKey, Moments> moments_;
  std::unordered_map<BlockKey, Vector3d> normals_;
};

/** Calls `visit(voxel, way within it)` along a segment (Amanatides and Woo, "A Fast Voxel Traversal
 * Algorithm for Ray Tracing", Eurographics 1987); in voxels. */
template <class Visit>
void walk(const Vector3d& from, const Vector3d& direction, double length, Visit&& visit) {
  VoxelIndex voxel = voxelAt(from), step;
  Vector3d next, delta;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = direction[axis];
    step[axis] = d > 0 ? 1 : -1;
    delta[axis] = d == 0 ? std::numeric_limits<double>::infinity() : std::abs(1 / d);
    const double ahead = d > 0 ? voxel[axis] + 1 - from[axis] : from[axis] - voxel[axis];
    next[axis] = d == 0 ? delta[axis] : ahead * delta[axis];
  }
  for (double at = 0; at < length;) {
    const int axis =
        next.x() < next.y() ? (next.x() < next.z() ? 0 : 2) : (next.y() < next.z() ? 1 : 2);
    const double end = std::min(next[axis], length);
    visit(voxel, end - at);
    at = end;
    voxel[axis] += step[axis];
    next[axis] += delta[axis];
  }
}

/** Finds a voxel's block; mostly it is the one asked for last. */
class BlockCursor {
 public:
  explicit BlockCursor(std::unordered_map<BlockKey, BlockRays>& blocks) : blocks_(blocks) {}

  BlockRays& at(const VoxelIndex& voxel) {
    const VoxelIndex place(voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3);
    if (!block_ || place != place_) {
      block_ = &blocks_[blockOf(voxel)];
      place_ = place;
    }
    return *block_;
  }

 private:
  static_assert(kBlockSide == 1 << 3);
  std::unordered_map<BlockKey, BlockRays>& blocks_;
  VoxelIndex place_ = VoxelIndex::Zero();
  BlockRays* block_ = nullptr;
};

class Caster {
 public:
  Caster(const Scan& scan, const Pose3& world_T_base, double resolution_m, double max_range_m)
      : max_range_(max_range_m / resolution_m) {
    std::vector<Vector3d> origins;
    for (const SensorOrigin& sensor : scan.sensors)
      origins.push_back(world_T_base * sensor.position / resolution_m);
    rays_.reserve(scan.size());
    for (size_t i = 0; i < scan.size(); ++i)
      addRay(origins[scan.sensor[i]], world_T_base * scan.points[i].cast<double>() / resolution_m);
  }

  ScanRays cast() {
    constexpr size_t kUsualBlocks = 1024;
    result_.blocks.reserve(kUsualBlocks);
    markHits();
    normals_.fit();
    markPasses();
    return std::move(result_);
  }

 private:
  struct Ray {
    Vector3d origin, direction;  ///< unit length
    double range = 0;
  };

  void addRay(const Vector3d& origin, const Vector3d& point) {
    const double range = (point - origin).norm();
    if (!std::isfinite(range)) return;
    const Ray ray{origin, range > 0 ? Vector3d((point - origin) / range) : Vector3d::UnitX(),
                  range};
    if (inGrid(origin) && inGrid(isCut(ray) ? endOf(ray, max_range_) : point))
      rays_.push_back(ray);
    else
      ++result_.out_of_bounds;
  }
  static bool inGrid(const Vector3d& p) {
    return p.cwiseAbs().maxCoeff() < kGridReach && isInGrid(voxelAt(p));
  }
  bool isCut(const Ray& ray) const { return ray.range > max_range_; }
  static Vector3d endOf(const Ray& ray, double range) { return ray.origin + range * ray.direction; }

  void markHits() {
    BlockCursor cursor(result_.blocks);
    for (const Ray& ray : rays_) {
      if (isCut(ray)) continue;
      const Vector3d end = endOf(ray, ray.range);
      const VoxelIndex voxel = voxelAt(end);
      normals_.add(blockOf(voxel), end - rays_.front().origin);
      BlockRays& block = cursor.at(voxel);
      if (block.hit.test(placeInBlock(voxel))) continue;
      block.hit.set(placeInBlock(voxel));
      markNear(voxel, cursor);
    }
  }
  static void markNear(const VoxelIndex& hit, BlockCursor& cursor) {
    for (int z = -1; z <= 1; ++z)
      for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
          const VoxelIndex voxel = hit + VoxelIndex(x, y, z);
          if (isInGrid(voxel)) cursor.at(voxel).near_hit.set(placeInBlock(voxel));
        }
  }

  void markPasses() {
    BlockCursor cursor(result_.blocks);
    for (const Ray& ray : rays_)
      walk(ray.origin, ray.direction, isCut(ray) ? max_range_ : ray.range - silentWay(ray),
           [&](const VoxelIndex& voxel, double way) {
             if (way >= kLeastWay) cursor.at(voxel).addPass(placeInBlock(voxel));
           });
  }
  /** How long before its end the ray is no witness. */
  double silentWay(const Ray& ray) const {
    const Vector3d& normal = normals_.at(blockOf(voxelAt(endOf(ray, ray.range))));
    const double sine = std::abs(normal.dot(ray.direction));
    if (sine >= kLeastSine) return kAcross / sine;
    return std::max(kAcross, kUnknownShare * ray.range);
  }

  const double max_range_;
  std::vector<Ray> rays_;
  SurfaceNormals normals_;
  ScanRays result_;
};

}  // namespace

bool BlockRays::saysSomething() const {
  uint64_t any = 0;
  for (size_t word = 0; word < kBlockSide; ++word) any |= hit.words[word] | pass(word);
  return any != 0;
}

void BlockRays::addPass(size_t place) {
  const size_t word = place / 64;
  const uint64_t bit = VoxelBits::bit(place);
  passed[2].words[word] |= passed[1].words[word] & bit;
  passed[1].words[word] |= passed[0].words[word] & bit;
  passed[0].words[word] |= bit;
}

ScanRays castRays(const Scan& scan, const Pose3& world_T_base, double resolution_m,
                  double max_range_m) {
  return Caster(scan, world_T_base, resolution_m, max_range_m).cast();
}

}  // namespace lamp
