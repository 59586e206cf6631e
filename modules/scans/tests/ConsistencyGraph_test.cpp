#include "lamp/scans/ConsistencyGraph.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace lamp {
namespace {

ConsistencyGraph randomGraph(size_t vertices, double density, unsigned seed) {
  ConsistencyGraph graph(vertices);
  std::mt19937 random(seed);
  std::bernoulli_distribution edge(density);
  for (size_t a = 0; a < vertices; ++a)
    for (size_t b = a + 1; b < vertices; ++b)
      if (edge(random)) graph.connect(a, b);
  return graph;
}

bool isClique(const ConsistencyGraph& graph, const std::vector<uint32_t>& vertices) {
  for (const uint32_t a : vertices)
    for (const uint32_t b : vertices)
      if (a != b && !graph.connected(a, b)) return false;
  return true;
}

size_t largestByBruteForce(const ConsistencyGraph& graph, const std::vector<bool>& allowed) {
  size_t largest = 0;
  for (uint32_t set = 0; set < uint32_t{1} << graph.size(); ++set) {
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < graph.size(); ++v)
      if (set >> v & 1) vertices.push_back(v);
    if (vertices.size() <= largest) continue;
    if (std::any_of(vertices.begin(), vertices.end(), [&](uint32_t v) { return !allowed[v]; }))
      continue;
    if (isClique(graph, vertices)) largest = vertices.size();
  }
  return largest;
}

TEST(MaximumClique, IsThatOfBruteForce) {
  std::mt19937 random(1);
  for (unsigned seed = 0; seed < 60; ++seed) {
    const size_t size = 1 + seed % 13;
    const ConsistencyGraph graph = randomGraph(size, 0.2 + 0.01 * seed, seed);
    std::vector<bool> allowed(size);
    for (size_t v = 0; v < size; ++v) allowed[v] = random() % 4 != 0;
    const auto clique = maximumClique(graph, allowed);
    EXPECT_TRUE(isClique(graph, clique));
    EXPECT_TRUE(std::is_sorted(clique.begin(), clique.end()));
    for (const uint32_t v : clique) EXPECT_TRUE(allowed[v]);
    EXPECT_EQ(clique.size(), largestByBruteForce(graph, allowed)) << seed;
  }
}

TEST(MaximumClique, FindsAPlantedOne) {
  for (unsigned seed = 0; seed < 3; ++seed) {
    ConsistencyGraph graph = randomGraph(1000, 0.05, seed);
    std::vector<uint32_t> planted;
    for (uint32_t k = 0; k < 20; ++k) planted.push_back(7 + 49 * k);
    for (const uint32_t a : planted)
      for (const uint32_t b : planted)
        if (a != b) graph.connect(a, b);
    EXPECT_EQ(maximumClique(graph, std::vector<bool>(1000, true)), planted);
    std::vector<bool> allowed(1000, true);
    allowed[planted.front()] = false;
    planted.erase(planted.begin());
    EXPECT_EQ(maximumClique(graph, allowed), planted);
  }
}

TEST(MaximumClique, OfGraphsWithoutOrWithAllEdges) {
  EXPECT_TRUE(maximumClique(ConsistencyGraph(0), {}).empty());
  EXPECT_EQ(maximumClique(ConsistencyGraph(5), std::vector<bool>(5, true)).size(), 1u);
  EXPECT_TRUE(maximumClique(ConsistencyGraph(5), std::vector<bool>(5, false)).empty());
  for (const size_t size : {63u, 64u, 65u, 200u})
    EXPECT_EQ(maximumClique(randomGraph(size, 1.0, 0), std::vector<bool>(size, true)).size(), size);
}

TEST(MaximumClique, IsAGoodOneWhenBranchesRunOut) {
  // Far more branches than the search may follow.
  const ConsistencyGraph graph = randomGraph(300, 0.5, 1);
  const auto clique = maximumClique(graph, std::vector<bool>(300, true));
  EXPECT_TRUE(isClique(graph, clique));
  EXPECT_GE(clique.size(), 8u);
}

}  // namespace
}  // namespace lamp
