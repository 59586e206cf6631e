#include "lamp/scans/ConsistencyGraph.h"

#include <gtest/gtest.h>

#include <random>

namespace lamp {
namespace {

ConsistencyGraph randomGraph(size_t vertices, double density, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit;
  ConsistencyGraph graph(vertices);
  for (size_t a = 0; a < vertices; ++a)
    for (size_t b = a + 1; b < vertices; ++b)
      if (unit(random) < density) graph.connect(a, b);
  return graph;
}

bool isClique(const ConsistencyGraph& graph, const std::vector<uint32_t>& vertices) {
  for (size_t i = 0; i < vertices.size(); ++i)
    for (size_t j = i + 1; j < vertices.size(); ++j)
      if (!graph.connected(vertices[i], vertices[j])) return false;
  return true;
}

size_t largestByBruteForce(const ConsistencyGraph& graph) {
  size_t largest = 0;
  for (uint32_t set = 0; set < 1u << graph.size(); ++set) {
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < graph.size(); ++v)
      if (set >> v & 1) vertices.push_back(v);
    if (vertices.size() > largest && isClique(graph, vertices)) largest = vertices.size();
  }
  return largest;
}

TEST(MaximumClique, IsAsLargeAsBruteForceFinds) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ConsistencyGraph graph = randomGraph(13, 0.2 + 0.03 * seed, seed);
    const auto clique = maximumClique(graph, std::vector<bool>(13, true));
    EXPECT_TRUE(isClique(graph, clique));
    EXPECT_EQ(clique.size(), largestByBruteForce(graph)) << seed;
  }
}

TEST(MaximumClique, FindsWhatWasPlanted) {
  ConsistencyGraph graph = randomGraph(600, 0.1, 5);
  std::vector<uint32_t> planted;
  for (uint32_t v = 7; v < 600; v += 25) planted.push_back(v);
  for (const uint32_t a : planted)
    for (const uint32_t b : planted)
      if (a < b) graph.connect(a, b);
  EXPECT_EQ(maximumClique(graph, std::vector<bool>(600, true)), planted);
}

TEST(MaximumClique, TakesOnlyWhatIsAllowed) {
  ConsistencyGraph graph(70);
  for (size_t a = 0; a < 70; ++a)
    for (size_t b = a + 1; b < 70; ++b) graph.connect(a, b);
  std::vector<bool> allowed(70, false);
  for (const size_t v : {3u, 64u, 69u}) allowed[v] = true;
  EXPECT_EQ(maximumClique(graph, allowed), (std::vector<uint32_t>{3, 64, 69}));
  EXPECT_EQ(maximumClique(graph, std::vector<bool>(70, true)).size(), 70u);
}

TEST(MaximumClique, OfNoVerticesIsEmptyAndWithoutEdgesASingleOne) {
  EXPECT_TRUE(maximumClique(ConsistencyGraph(0), {}).empty());
  EXPECT_EQ(maximumClique(ConsistencyGraph(5), std::vector<bool>(5, true)).size(), 1u);
  EXPECT_TRUE(maximumClique(ConsistencyGraph(5), std::vector<bool>(5, false)).empty());
}

}  // namespace
}  // namespace lamp
