#include "lamp/scans/Features.h"

#include <algorithm>
#include <cmath>

#include "NeighborPairs.h"
#include "lamp/core/KdTree.h"
#include "lamp/core/SurfaceNormals.h"

namespace lamp {

namespace {

using Eigen::Vector3f;

constexpr int kBins = Features::kDimensions / 3;

/** The angles between two points with normals (Rusu et al. 2009, equation 1), each in [-1, 1]. */
struct PairFeature {
  float alpha, phi, theta;
};

/** An approximation of atan2(y, x) / pi, good to 0.002: finer than the bins by far. */
float atan2OverPi(float y, float x) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float ratio = std::min(ax, ay) / std::max(std::max(ax, ay), 1e-12f);
  float angle = ratio * (0.25f + 0.273f / static_cast<float>(M_PI) * (1.0f - ratio));
  if (ay > ax) angle = 0.5f - angle;
  if (x < 0) angle = 1.0f - angle;
  return y < 0 ? -angle : angle;
}

/** \param direction unit vector from the first point to the second one. Symmetric: the point whose
 * normal lies nearer to the line takes the lead. */
PairFeature pairFeature(const Vector3f& n1, const Vector3f& n2, Vector3f direction) {
  const bool swap = std::abs(n1.dot(direction)) < std::abs(n2.dot(direction));
  const Vector3f& u = swap ? n2 : n1;
  const Vector3f& n = swap ? n1 : n2;
  if (swap) direction = -direction;
  const Vector3f v = direction.cross(u).normalized();
  const Vector3f w = u.cross(v);
  return {v.dot(n), u.dot(direction), atan2OverPi(w.dot(n), u.dot(n))};
}

int bin(float value) {
  return std::clamp(static_cast<int>((value + 1.0f) * (0.5f * kBins)), 0, kBins - 1);
}

/** Simplified histograms, each of sum 1: what a point's own pairs look like. */
Features::Descriptors simplifiedHistograms(const std::vector<Vector3f>& points,
                                           const std::vector<Vector3f>& normals,
                                           const std::vector<NeighborPair>& pairs) {
  Features::Descriptors histograms =
      Features::Descriptors::Zero(Features::kDimensions, static_cast<Eigen::Index>(points.size()));
  for (const NeighborPair& pair : pairs) {
    const Vector3f direction = (points[pair.j] - points[pair.i]) / std::sqrt(pair.squared_distance);
    const PairFeature f = pairFeature(normals[pair.i], normals[pair.j], direction);
    for (const int row : {bin(f.alpha), kBins + bin(f.phi), 2 * kBins + bin(f.theta)}) {
      histograms(row, pair.i) += 1.0f;
      histograms(row, pair.j) += 1.0f;
    }
  }
  for (Eigen::Index i = 0; i < histograms.cols(); ++i)
    histograms.col(i) /= std::max(histograms.col(i).sum(), 1.0f);
  return histograms;
}

/** Each point's histogram with those of its neighbours, weighted by their nearness. The square
 * roots of the entries compare better than the entries: few full bins do not outshout the rest. */
Features::Descriptors fastHistograms(const Features::Descriptors& simplified,
                                     const std::vector<NeighborPair>& pairs) {
  constexpr float kNearest2 = 1e-6f;  // metres²; nearer ones would drown the rest, or overflow
  Features::Descriptors sums =
      Features::Descriptors::Zero(Features::kDimensions, simplified.cols());
  for (const NeighborPair& pair : pairs) {
    const float weight = 1.0f / std::max(pair.squared_distance, kNearest2);
    sums.col(pair.i) += weight * simplified.col(pair.j);
    sums.col(pair.j) += weight * simplified.col(pair.i);
  }
  for (Eigen::Index i = 0; i < sums.cols(); ++i) {
    const float total = sums.col(i).sum();
    if (total > 0) sums.col(i) = (sums.col(i) / total + simplified.col(i)).cwiseSqrt().normalized();
  }
  return sums;
}

/** Places of the columns that differ most from the mean column, in ascending order. */
std::vector<Eigen::Index> mostDistinctive(const Features::Descriptors& descriptors,
                                          const std::vector<Eigen::Index>& eligible, size_t count) {
  std::vector<Eigen::Index> chosen = eligible;
  if (chosen.size() <= count) return chosen;
  Eigen::VectorXf mean = Eigen::VectorXf::Zero(descriptors.rows());
  for (const Eigen::Index i : eligible) mean += descriptors.col(i);
  const Eigen::VectorXf likeness = descriptors.transpose() * mean;
  std::nth_element(chosen.begin(), chosen.begin() + static_cast<std::ptrdiff_t>(count),
                   chosen.end(), [&](Eigen::Index a, Eigen::Index b) {
                     return std::pair(likeness[a], a) < std::pair(likeness[b], b);
                   });
  chosen.resize(count);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

void FeatureOptions::visit(OptionVisitor& v) {
  v("feature_voxel_m", voxel_m, "m", "voxel size of the clouds that descriptors are computed on",
    kPositive);
  v("feature_normal_neighbors", normal_neighbors, "points",
    "number of nearest voxels used to fit a descriptor's normals", {3});
  v("descriptor_radius_m", descriptor_radius_m, "m", "radius of a descriptor's neighbourhood",
    kPositive);
  v("max_keypoints", max_keypoints, "points",
    "maximum number of keypoints per scan; the most distinctive are kept", {10});
}

Features computeFeatures(const Cloud& cloud, const FeatureOptions& options, double coarseness) {
  const Cloud means = voxelMeans(cloud, coarseness * options.voxel_m);
  const KdTree tree(means.points);
  std::vector<Vector3f> normals =
      fitPlanes(means.points, tree, options.normal_neighbors, false).normals;
  turnTowardsViewpoints(means, normals);
  std::vector<NeighborPair> pairs =
      neighborPairs(means.points, coarseness * options.descriptor_radius_m);
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                             [&](const NeighborPair& pair) {
                               return normals[pair.i].isZero() || normals[pair.j].isZero();
                             }),
              pairs.end());
  const Features::Descriptors descriptors =
      fastHistograms(simplifiedHistograms(means.points, normals, pairs), pairs);

  std::vector<Eigen::Index> eligible;
  for (Eigen::Index i = 0; i < descriptors.cols(); ++i)
    if (!descriptors.col(i).isZero()) eligible.push_back(i);
  const auto chosen =
      mostDistinctive(descriptors, eligible, static_cast<size_t>(options.max_keypoints));
  Features features;
  features.coarseness = coarseness;
  features.descriptors.resize(Features::kDimensions, static_cast<Eigen::Index>(chosen.size()));
  for (const Eigen::Index i : chosen) {
    features.descriptors.col(static_cast<Eigen::Index>(features.size())) = descriptors.col(i);
    features.points.push_back(means.points[static_cast<size_t>(i)]);
    features.normals.push_back(normals[static_cast<size_t>(i)]);
  }
  return features;
}

}  // namespace lamp
