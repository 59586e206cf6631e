#include "lamp/scans/DescriptorMatching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace lamp {
namespace {

Features randomFeatures(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  Features features;
  features.points.assign(static_cast<size_t>(count), Eigen::Vector3f::Zero());
  features.normals = features.points;
  features.descriptors = Features::Descriptors::NullaryExpr(Features::kDimensions, count,
                                                            [&] { return normal(random); });
  features.descriptors.colwise().normalize();
  return features;
}

/** Places of the `rank` largest entries, largest first; of equal ones the first. */
std::vector<uint32_t> largest(const Eigen::VectorXf& values, int rank) {
  std::vector<uint32_t> order(static_cast<size_t>(values.size()));
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return values[a] > values[b]; });
  order.resize(std::min(order.size(), static_cast<size_t>(rank)));
  return order;
}

bool holds(const std::vector<uint32_t>& places, uint32_t place) {
  return std::find(places.begin(), places.end(), place) != places.end();
}

TEST(MutualMatches, AreThoseOfBruteForce) {
  const Features source = randomFeatures(150, 1), target = randomFeatures(131, 2);
  const Eigen::MatrixXf similarity = source.descriptors.transpose() * target.descriptors;
  for (const int rank : {1, 3, 200}) {
    std::vector<Match> expected;
    for (uint32_t i = 0; i < 150; ++i)
      for (uint32_t j = 0; j < 131; ++j)
        if (holds(largest(similarity.row(i), rank), j) &&
            holds(largest(similarity.col(j), rank), i))
          expected.push_back({i, j});
    EXPECT_EQ(mutualMatches(source, target, rank), expected) << rank;
  }
}

TEST(MutualMatches, AreTheSameBothWays) {
  const Features a = randomFeatures(100, 1), b = randomFeatures(90, 2);
  std::vector<Match> back = mutualMatches(b, a, 2);
  for (Match& match : back) std::swap(match.source, match.target);
  std::sort(back.begin(), back.end(), [](const Match& x, const Match& y) {
    return std::pair(x.source, x.target) < std::pair(y.source, y.target);
  });
  EXPECT_EQ(mutualMatches(a, b, 2), back);
}

TEST(MutualMatches, OfEqualKeypointsTheFirstOnesMatch) {
  Features equal = randomFeatures(3, 1);
  equal.descriptors.col(1) = equal.descriptors.col(2) = equal.descriptors.col(0);
  EXPECT_EQ(mutualMatches(equal, equal, 1), (std::vector<Match>{{0, 0}}));
}

TEST(MutualMatches, NoneWithoutKeypointsOrRank) {
  const Features some = randomFeatures(5, 1), none = randomFeatures(0, 1);
  EXPECT_TRUE(mutualMatches(some, none, 2).empty());
  EXPECT_TRUE(mutualMatches(none, some, 2).empty());
  EXPECT_TRUE(mutualMatches(some, some, 0).empty());
}

TEST(MostSimilar, AreThoseOfBruteForce) {
  const Features source = randomFeatures(40, 1), target = randomFeatures(70, 2);
  const auto found = mostSimilar(source, target, 5);
  const Eigen::MatrixXf similarity = source.descriptors.transpose() * target.descriptors;
  ASSERT_EQ(found.rows(), 5);
  ASSERT_EQ(found.cols(), 40);
  for (int i = 0; i < 40; ++i) {
    const auto expected = largest(similarity.row(i), 5);
    for (int k = 0; k < 5; ++k) EXPECT_EQ(found(k, i), expected[static_cast<size_t>(k)]);
  }
}

TEST(MostSimilar, NoMoreThanThereAre) {
  const Features some = randomFeatures(5, 1), none = randomFeatures(0, 1);
  EXPECT_EQ(mostSimilar(some, some, 9).rows(), 5);
  EXPECT_EQ(mostSimilar(some, none, 9).rows(), 0);
  EXPECT_EQ(mostSimilar(some, some, -1).rows(), 0);
}

}  // namespace
}  // namespace lamp
