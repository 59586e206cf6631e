#include "PlateMiddle.h"

#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPlateCells = 60;  ///< along an edge
constexpr int kReachCells = 45;  ///< how far the middle is looked for, each way
constexpr int kGridCells = kPlateCells + 2 * kReachCells;
constexpr double kLikelihoodOfError = 0.01;  ///< that a ray tells the wrong thing: dust, drop-outs
constexpr double kRangeMargin_m = 0.15;
constexpr double kEdgeSigma_m = 0.005;   ///< of where a plate seems to end
constexpr double kDepthSigma_m = 0.002;  ///< of a lidar's mean range, from plate to plate
constexpr size_t kFewestHits = 4;

/** Rays counted by where they pass the plate's plane; sums over rectangles from the corner. */
class RayGrid {
 public:
  void add(int column, int row) { ++sums_[static_cast<size_t>((row + 1) * kSide + column + 1)]; }
  void finish() {
    for (int row = 1; row < kSide; ++row)
      for (int column = 1; column < kSide; ++column)
        at(row, column) += at(row, column - 1) + at(row - 1, column) - at(row - 1, column - 1);
  }
  /** In a square of the plate's size with this corner. */
  int inPlate(int column, int row) const {
    return at(row + kPlateCells, column + kPlateCells) - at(row, column + kPlateCells) -
           at(row + kPlateCells, column) + at(row, column);
  }
  int all() const { return at(kSide - 1, kSide - 1); }

 private:
  static constexpr int kSide = kGridCells + 1;
  int at(int row, int column) const { return sums_[static_cast<size_t>(row * kSide + column)]; }
  int& at(int row, int column) { return sums_[static_cast<size_t>(row * kSide + column)]; }

  std::vector<int> sums_ = std::vector<int>(static_cast<size_t>(kSide * kSide));
};

/** What rays say of a plate. */
struct Evidence {
  RayGrid hits, misses;
  std::vector<double> depths;  ///< of the hits across the plate, metres
};

/** Counts a ray that passes the plane of a plate nearby. */
void judge(const JudgedRay& judged, const Vector3d& middle, const PlateFrame& plates,
           Evidence& evidence) {
  const Eigen::Matrix3d plate_R_base = plates.base_R_plate.transpose();
  const Vector3d origin = plate_R_base * (judged.ray.origin.cast<double>() - middle);
  const Vector3d point = plate_R_base * (judged.ray.point.cast<double>() - middle);
  const Vector3d along = point - origin;
  if (along.z() * origin.z() >= 0) return;  // away from the plate
  const double share = -origin.z() / along.z();
  const double beyond = (1.0 - share) * along.norm();
  const Vector2d passes = (origin + share * along).head<2>() * kPlateCells / plates.size_m;
  const double column = std::floor(passes.x() + 0.5 * kGridCells);
  const double row = std::floor(passes.y() + 0.5 * kGridCells);
  if (!(column >= 0 && row >= 0 && column < kGridCells && row < kGridCells)) return;
  if (judged.shines && std::abs(beyond) < kRangeMargin_m) {
    evidence.hits.add(static_cast<int>(column), static_cast<int>(row));
    evidence.depths.push_back(point.z());
  } else if (beyond > -kRangeMargin_m && !judged.shines) {
    evidence.misses.add(static_cast<int>(column), static_cast<int>(row));
  }
}

/** Mean and covariance of the middle in the plane, in cells. */
struct InPlane {
  Vector2d mean = Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  int contradicting = 0;
};

InPlane middleInPlane(const Evidence& evidence) {
  const auto contradicting = [&](int column, int row) {
    return evidence.hits.all() - evidence.hits.inPlate(column, row) +
           evidence.misses.inPlate(column, row);
  };
  InPlane result;
  result.contradicting = contradicting(kReachCells, kReachCells);
  for (int row = 0; row <= 2 * kReachCells; ++row)
    for (int column = 0; column <= 2 * kReachCells; ++column)
      result.contradicting = std::min(result.contradicting, contradicting(column, row));
  double sum = 0;
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (int row = 0; row <= 2 * kReachCells; ++row)
    for (int column = 0; column <= 2 * kReachCells; ++column) {
      const double weight =
          std::pow(kLikelihoodOfError, contradicting(column, row) - result.contradicting);
      const Vector2d at(column - kReachCells, row - kReachCells);
      sum += weight;
      result.mean += weight * at;
      squares += weight * at * at.transpose();
    }
  result.mean /= sum;
  result.covariance = squares / sum - result.mean * result.mean.transpose();
  return result;
}

}  // namespace

std::optional<PlateMiddle> plateMiddle(const std::vector<JudgedRay>& rays,
                                       const PlateFrame& plates) {
  Evidence evidence;
  for (const JudgedRay& ray : rays)
    for (const Vector3d& middle : plates.middles) judge(ray, middle, plates, evidence);
  evidence.hits.finish();
  evidence.misses.finish();
  const size_t hits = evidence.depths.size();
  if (hits < kFewestHits) return std::nullopt;
  const InPlane in_plane = middleInPlane(evidence);
  const double cell = plates.size_m / kPlateCells;
  const Eigen::Map<const Eigen::VectorXd> depths(evidence.depths.data(),
                                                 static_cast<Eigen::Index>(hits));
  const double depth = depths.mean();
  const double variance = (depths.array() - depth).square().sum() / static_cast<double>(hits - 1);

  Vector3d in_plate;
  in_plate << cell * in_plane.mean, depth;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance.topLeftCorner<2, 2>() =
      cell * cell * in_plane.covariance + kEdgeSigma_m * kEdgeSigma_m * Eigen::Matrix2d::Identity();
  covariance(2, 2) = kDepthSigma_m * kDepthSigma_m + variance / static_cast<double>(hits);
  return PlateMiddle{plates.middles.front() + plates.base_R_plate * in_plate,
                     plates.base_R_plate * covariance * plates.base_R_plate.transpose(),
                     in_plane.contradicting / static_cast<double>(hits)};
}

}  // namespace lamp
