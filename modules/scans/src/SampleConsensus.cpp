#include "lamp/scans/SampleConsensus.h"

#include <array>
#include <random>

#include "lamp/scans/RobustPose.h"

namespace lamp {

namespace {

constexpr size_t kSamples = 3;
using Sample = std::array<uint32_t, kSamples>;

bool spreadOut(const Features& source, const Sample& sample, double distance_m) {
  for (size_t a = 0; a < kSamples; ++a)
    for (size_t b = a + 1; b < kSamples; ++b)
      if ((source.points[sample[a]] - source.points[sample[b]]).norm() < distance_m) return false;
  return true;
}

/** How well a pose brings keypoints near a scan. */
struct Fit {
  double cost = 0;  ///< sum of squared distances, each as a share of the largest that counts
  size_t inliers = 0;
};

Fit fitOf(const Pose3& pose, const Features& source, const PreparedScan& target,
          double distance_m) {
  const Eigen::Isometry3f T = pose.cast<float>();
  Fit fit;
  for (const Eigen::Vector3f& point : source.points) {
    float squared;
    const bool near =
        target.tree().nearest(T * point, static_cast<float>(distance_m), squared) != KdTree::kNone;
    fit.cost += near ? squared / (distance_m * distance_m) : 1.0;
    fit.inliers += near;
  }
  return fit;
}

}  // namespace

void SampleConsensusOptions::visit(OptionVisitor& v) {
  v("iterations", iterations, "", "number of poses tried", {1});
  v("similar_keypoints", similar_keypoints, "",
    "a sample's match is drawn from this many most similar keypoints", {1});
  v("min_sample_distance_m", min_sample_distance_m, "m", "minimum distance between samples",
    kNotNegative);
  v("correspondence_m", correspondence_m, "m", "distances are truncated at this value", kPositive);
}

std::optional<GlobalPose> alignBySamples(const Features& source, const PreparedScan& target,
                                         const SampleConsensusOptions& options) {
  const Features& partners = target.features();
  if (source.size() < kSamples || partners.size() < kSamples) return std::nullopt;
  const auto similar = mostSimilar(source, partners, options.similar_keypoints);
  std::mt19937 random(options.seed);
  const auto draw = [&](size_t count) { return static_cast<uint32_t>(random() % count); };
  std::optional<GlobalPose> best;
  double least = 0;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    Sample sample;
    for (uint32_t& keypoint : sample) keypoint = draw(source.size());
    if (!spreadOut(source, sample, options.min_sample_distance_m)) continue;
    std::vector<PointPair> pairs;
    for (const uint32_t keypoint : sample) {
      const uint32_t partner = similar(draw(static_cast<size_t>(similar.rows())), keypoint);
      pairs.push_back(
          {source.points[keypoint].cast<double>(), partners.points[partner].cast<double>()});
    }
    const Pose3 pose = leastSquaresPose(pairs, false);
    const Fit fit = fitOf(pose, source, target, options.correspondence_m);
    if (best && fit.cost >= least) continue;
    least = fit.cost;
    best = GlobalPose{pose, fit.inliers,
                      static_cast<double>(fit.inliers) / static_cast<double>(source.size())};
  }
  return best;
}

}  // namespace lamp
