#include "lamp/scans/DescriptorMatching.h"

#include <algorithm>

#include "VectorKernels.h"

namespace lamp {

namespace {

constexpr float kLeastSimilar = -2.0f;

/** The best few of a row of similarities, best first. */
class BestFew {
 public:
  explicit BestFew(int count)
      : similarity_(static_cast<size_t>(count), kLeastSimilar), place_(similarity_.size(), kNone) {}

  float worst() const { return similarity_.back(); }
  void take(float similarity, uint32_t place) {
    if (!(similarity > worst())) return;
    size_t k = similarity_.size() - 1;
    for (; k > 0 && similarity > similarity_[k - 1]; --k) {
      similarity_[k] = similarity_[k - 1];
      place_[k] = place_[k - 1];
    }
    similarity_[k] = similarity;
    place_[k] = place;
  }
  const std::vector<uint32_t>& places() const { return place_; }
  bool holds(uint32_t place) const {
    return std::find(place_.begin(), place_.end(), place) != place_.end();
  }

  static constexpr uint32_t kNone = UINT32_MAX;

 private:
  std::vector<float> similarity_;
  std::vector<uint32_t> place_;
};

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/** Calls `take(i, row)` with the similarities of source keypoint i to all of the target's. */
template <class Take>
void forSimilarities(const Features& source, const Features& target, const Take& take) {
  const RowMajor by_dimension = target.descriptors;
  std::vector<float> row(target.size());
  for (size_t i = 0; i < source.size(); ++i) {
    weightedRowSum(by_dimension.data(), target.size(),
                   source.descriptors.col(static_cast<Eigen::Index>(i)).data(),
                   Features::kDimensions, row.data());
    take(i, row);
  }
}

/** Makes the keypoints outside of a sphere less similar than any can be. */
void excludeOutside(const Eigen::Vector3f& center, float radius, const Features& target,
                    std::vector<float>& similarities) {
  for (size_t j = 0; j < target.size(); ++j)
    if ((target.points[j] - center).squaredNorm() > radius * radius)
      similarities[j] = kLeastSimilar;
}

}  // namespace

std::vector<Match> mutualMatches(const Features& source, const Features& target, int rank,
                                 const std::optional<Whereabouts>& whereabouts) {
  if (rank < 1) return {};
  std::vector<BestFew> of_source(source.size(), BestFew(rank)),
      of_target(target.size(), BestFew(rank));
  std::vector<float> worst(target.size(), kLeastSimilar);
  forSimilarities(source, target, [&](size_t i, std::vector<float>& row) {
    if (whereabouts) excludeOutside(whereabouts->centers[i], whereabouts->radii[i], target, row);
    for (size_t j = 0; j < row.size(); ++j) {
      of_source[i].take(row[j], static_cast<uint32_t>(j));
      if (row[j] > worst[j]) {
        of_target[j].take(row[j], static_cast<uint32_t>(i));
        worst[j] = of_target[j].worst();
      }
    }
  });
  std::vector<Match> matches;
  for (uint32_t i = 0; i < source.size(); ++i) {
    std::vector<uint32_t> partners = of_source[i].places();
    std::sort(partners.begin(), partners.end());
    for (const uint32_t j : partners)
      if (j != BestFew::kNone && of_target[j].holds(i)) matches.push_back({i, j});
  }
  return matches;
}

Eigen::Matrix<uint32_t, Eigen::Dynamic, Eigen::Dynamic> mostSimilar(const Features& source,
                                                                    const Features& target,
                                                                    int count) {
  const int rows = std::clamp(count, 0, static_cast<int>(target.size()));
  Eigen::Matrix<uint32_t, Eigen::Dynamic, Eigen::Dynamic> result(
      rows, static_cast<Eigen::Index>(source.size()));
  if (rows == 0) return result;
  forSimilarities(source, target, [&](size_t i, const std::vector<float>& row) {
    BestFew best(rows);
    for (size_t j = 0; j < row.size(); ++j) best.take(row[j], static_cast<uint32_t>(j));
    for (int k = 0; k < rows; ++k)
      result(k, static_cast<Eigen::Index>(i)) = best.places()[static_cast<size_t>(k)];
  });
  return result;
}

}  // namespace lamp
