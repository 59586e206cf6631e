#include "lamp/scans/RobustPose.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace lamp {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/** The rotation that maximises trace(R · correlation), correlation = Σ w source targetᵀ. */
Matrix3d rotationFrom(const Matrix3d& correlation, bool upright) {
  if (upright) {
    const double yaw =
        std::atan2(correlation(0, 1) - correlation(1, 0), correlation(0, 0) + correlation(1, 1));
    return Eigen::AngleAxisd(yaw, Vector3d::UnitZ()).toRotationMatrix();
  }
  const Eigen::JacobiSVD<Matrix3d> svd(correlation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d mirror = Matrix3d::Identity();
  mirror(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixV() * mirror * svd.matrixU().transpose();
}

Matrix3d weightedRotation(const std::vector<PointPair>& vectors, const std::vector<double>& weights,
                          bool upright) {
  Matrix3d correlation = Matrix3d::Zero();
  for (size_t i = 0; i < vectors.size(); ++i)
    correlation.noalias() += weights[i] * vectors[i].source * vectors[i].target.transpose();
  return rotationFrom(correlation, upright);
}

/** Differences of all pairs of points, or of the nearest in sequence where that would be many. */
std::vector<PointPair> differences(const std::vector<PointPair>& pairs) {
  constexpr size_t kMaxSteps = 40;
  std::vector<PointPair> result;
  for (size_t step = 1; step < std::min(pairs.size(), kMaxSteps + 1); ++step)
    for (size_t i = 0; i + step < pairs.size(); ++i)
      result.push_back(
          {pairs[i + step].source - pairs[i].source, pairs[i + step].target - pairs[i].target});
  return result;
}

}  // namespace

Matrix3d robustRotation(const std::vector<PointPair>& vectors, double noise_m, bool upright) {
  constexpr double kMuStep = 1.4;
  constexpr int kMaxRounds = 100;
  const double c2 = noise_m * noise_m;
  std::vector<double> weights(vectors.size(), 1.0), squared(vectors.size());
  Matrix3d R = Matrix3d::Identity();
  double mu = 0;
  for (int round = 0; round < kMaxRounds; ++round, mu *= kMuStep) {
    R = weightedRotation(vectors, weights, upright);
    for (size_t i = 0; i < vectors.size(); ++i)
      squared[i] = (vectors[i].target - R * vectors[i].source).squaredNorm();
    if (round == 0) {
      const double largest =
          squared.empty() ? 0 : *std::max_element(squared.begin(), squared.end());
      if (largest <= c2) return R;
      mu = c2 / (2 * largest - c2);
    }
    // GNC, equation 14: sure inliers, sure outliers, and a smooth slope between.
    bool binary = true;
    for (size_t i = 0; i < vectors.size(); ++i) {
      const bool inlier = squared[i] <= mu / (mu + 1) * c2;
      const bool outlier = squared[i] >= (mu + 1) / mu * c2;
      binary = binary && (inlier || outlier);
      weights[i] = inlier ? 1.0 : outlier ? 0.0 : std::sqrt(c2 * mu * (mu + 1) / squared[i]) - mu;
    }
    if (binary) return weightedRotation(vectors, weights, upright);
  }
  return R;
}

double adaptiveVote(std::vector<double> measurements, double noise) {
  if (measurements.empty()) return 0;
  std::sort(measurements.begin(), measurements.end());
  size_t best_first = 0, best_last = 0;
  for (size_t first = 0, last = 0; last < measurements.size(); ++last) {
    while (measurements[last] - measurements[first] > 2 * noise) ++first;
    if (last - first > best_last - best_first) {
      best_first = first;
      best_last = last;
    }
  }
  double sum = 0;
  for (size_t i = best_first; i <= best_last; ++i) sum += measurements[i];
  return sum / static_cast<double>(best_last - best_first + 1);
}

Pose3 leastSquaresPose(const std::vector<PointPair>& pairs, bool upright) {
  Vector3d source_mean = Vector3d::Zero(), target_mean = Vector3d::Zero();
  for (const PointPair& pair : pairs) {
    source_mean += pair.source;
    target_mean += pair.target;
  }
  source_mean /= static_cast<double>(pairs.size());
  target_mean /= static_cast<double>(pairs.size());
  Matrix3d correlation = Matrix3d::Zero();
  for (const PointPair& pair : pairs)
    correlation.noalias() += (pair.source - source_mean) * (pair.target - target_mean).transpose();
  Pose3 pose = Pose3::Identity();
  pose.linear() = rotationFrom(correlation, upright);
  pose.translation() = target_mean - pose.linear() * source_mean;
  return pose;
}

std::optional<Pose3> robustPose(const std::vector<PointPair>& pairs, double noise_m, bool upright) {
  constexpr size_t kLeastInliers = 3;
  if (pairs.size() < kLeastInliers) return std::nullopt;
  const Matrix3d R = robustRotation(differences(pairs), 2 * noise_m, upright);
  Vector3d t;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> offsets;
    for (const PointPair& pair : pairs) offsets.push_back((pair.target - R * pair.source)[axis]);
    t[axis] = adaptiveVote(std::move(offsets), noise_m);
  }
  std::vector<PointPair> inliers;
  for (const PointPair& pair : pairs)
    if ((pair.target - R * pair.source - t).norm() <= 2 * noise_m) inliers.push_back(pair);
  if (inliers.size() < kLeastInliers) return std::nullopt;
  return leastSquaresPose(inliers, upright);
}

}  // namespace lamp
