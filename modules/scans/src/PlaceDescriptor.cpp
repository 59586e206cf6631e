#include "lamp/scans/PlaceDescriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "lamp/core/VoxelSet.h"

namespace lamp {

namespace {

using Complex = std::complex<float>;

constexpr int kRings = 12, kPlanarRings = 24;
// Floor, furniture and low walls; high walls and ceilings. The robots' heights differ.
constexpr int kHeights = 2;
constexpr float kUpperFrom_m = 1.0F;
constexpr int kSectors = 64;
constexpr int kHarmonics = 20;
constexpr int kHeadings = 90;

/** exp(-i 2π n / count) for n = 0, 1, ... count-1. */
template <int count>
const std::array<Complex, count>& roots() {
  static const std::array<Complex, count> result = [] {
    std::array<Complex, count> made;
    for (int n = 0; n < count; ++n)
      made[static_cast<size_t>(n)] = Complex(std::polar(1.0, -2 * M_PI * n / count));
    return made;
  }();
  return result;
}

/** Counts of points: a row for each ring and height, a column for each sector. */
Eigen::MatrixXf polarCounts(const std::vector<Eigen::Vector3f>& points, float radius_m,
                            bool planar) {
  const int rings = planar ? kPlanarRings : kRings, heights = planar ? 1 : kHeights;
  Eigen::MatrixXf counts = Eigen::MatrixXf::Zero(rings * heights, kSectors);
  for (const Eigen::Vector3f& point : points) {
    const float range = std::hypot(point.x(), point.y());
    if (!(range < radius_m)) continue;
    const int height = !planar && point.z() >= kUpperFrom_m ? 1 : 0;
    const double turns = std::atan2(point.y(), point.x()) / (2 * M_PI);
    const int sector = static_cast<int>((turns - std::floor(turns)) * kSectors) % kSectors;
    // Shared by the two rings whose middles are nearest, so that a small step changes little.
    const float place = range / radius_m * static_cast<float>(rings) - 0.5F;
    const float inner = std::floor(place), outer_share = place - inner;
    const int ring = static_cast<int>(inner);
    if (ring >= 0) counts(ring * heights + height, sector) += 1 - outer_share;
    if (ring + 1 < rings) counts((ring + 1) * heights + height, sector) += outer_share;
  }
  return counts;
}

}  // namespace

Eigen::Matrix3d levelFrame(const Pose3& odom_T_base) {
  return Eigen::AngleAxisd(-yawOf(odom_T_base), Eigen::Vector3d::UnitZ()) * odom_T_base.linear();
}

std::vector<Eigen::Vector3f> surroundings(const std::vector<PlacedScan>& scans, double radius_m,
                                          bool planar) {
  constexpr double kVoxel_m = 0.5, kPlanarVoxel_m = 0.2;
  VoxelSet voxels(planar ? kPlanarVoxel_m : kVoxel_m);
  std::vector<Eigen::Vector3f> points;
  for (const PlacedScan& placed : scans) {
    const Eigen::Isometry3f level_T_scan = placed.target_T_scan.cast<float>();
    for (const Eigen::Vector3f& point : placed.scan->points) {
      const Eigen::Vector3f p = level_T_scan * point;
      if (p.head<2>().norm() < radius_m && std::abs(p.z()) < radius_m &&
          voxels.insert(p.cast<double>()))
        points.push_back(p);
    }
  }
  return points;
}

PlaceDescriptor::PlaceDescriptor(const std::vector<Eigen::Vector3f>& points, double radius_m,
                                 bool planar)
    : planar_(planar) {
  // Square roots: of many points in one cell the first tell more than the last.
  const Eigen::MatrixXf counts =
      polarCounts(points, static_cast<float>(radius_m), planar).cwiseSqrt();
  Eigen::MatrixXcf waves(kSectors, kHarmonics + 1);
  for (int k = 0; k <= kHarmonics; ++k)
    for (int s = 0; s < kSectors; ++s)
      waves(s, k) = roots<kSectors>()[static_cast<size_t>(k * s % kSectors)] *
                    (k == 0 ? 1.0F : std::sqrt(2.0F));  // stands for the harmonic -k, too
  spectrum_ = counts * waves;
  const float norm = spectrum_.norm();
  if (norm > 0) spectrum_ /= norm;
  magnitudes_ = spectrum_.reshaped().cwiseAbs();
}

PlaceMatch match(const PlaceDescriptor& a, const PlaceDescriptor& b) {
  PlaceMatch match;
  if (a.planar_ != b.planar_) return match;
  const Eigen::RowVectorXcf cross =
      a.spectrum_.conjugate().cwiseProduct(b.spectrum_).colwise().sum();
  std::array<double, kHeadings> correlation;
  for (int h = 0; h < kHeadings; ++h) {
    float sum = 0;
    for (int k = 0; k <= kHarmonics; ++k)
      sum += (cross[k] * roots<kHeadings>()[static_cast<size_t>(k * h % kHeadings)]).real();
    correlation[static_cast<size_t>(h)] = sum;
  }
  const auto best = static_cast<size_t>(std::max_element(correlation.begin(), correlation.end()) -
                                        correlation.begin());
  match.similarity = correlation[best];
  // The vertex of the parabola through the best heading and its neighbours.
  const double before = correlation[(best + kHeadings - 1) % kHeadings],
               after = correlation[(best + 1) % kHeadings];
  const double bend = before - 2 * correlation[best] + after;
  const double offset = bend < 0 ? 0.5 * (before - after) / bend : 0;
  match.heading = (static_cast<double>(best) + offset) * 2 * M_PI / kHeadings;
  if (match.heading > M_PI) match.heading -= 2 * M_PI;
  return match;
}

}  // namespace lamp
