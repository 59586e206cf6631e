#include "rejection/GrowingClique.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace lamp {
namespace {

using testing::ElementsAre;

/** Size of the largest clique by trying all sets. */
int bruteForce(const std::vector<std::vector<bool>>& rows) {
  const int size = static_cast<int>(rows.size());
  int best = 0;
  for (int set = 0; set < 1 << size; ++set) {
    bool clique = true;
    for (int a = 0; a < size && clique; ++a)
      for (int b = 0; b < a && clique; ++b)
        if ((set >> a & 1) && (set >> b & 1)) clique = rows[a][b];
    if (clique) best = std::max(best, __builtin_popcount(static_cast<unsigned>(set)));
  }
  return best;
}

TEST(GrowingClique, IsTheLargestAfterEachVertex) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    GrowingClique clique(100000);
    std::vector<std::vector<bool>> rows;
    for (int vertex = 0; vertex < 13; ++vertex) {
      std::vector<bool> row;
      for (int other = 0; other < vertex; ++other) row.push_back(random() % 10 < 6);
      rows.push_back(row);
      clique.add(row);
      EXPECT_EQ(static_cast<int>(clique.clique().size()), bruteForce(rows));
      for (const int a : clique.clique())
        for (const int b : clique.clique()) EXPECT_TRUE(b >= a || rows[a][b]);
    }
    EXPECT_TRUE(clique.exact());
  }
}

TEST(GrowingClique, ALargerSetTakesOver) {
  GrowingClique clique(1000);
  clique.add({});
  clique.add({true});
  EXPECT_THAT(clique.clique(), ElementsAre(0, 1));
  clique.add({false, false});
  clique.add({false, false, true});
  clique.add({false, false, true, true});
  EXPECT_THAT(clique.clique(), ElementsAre(2, 3, 4));
}

TEST(GrowingClique, OutOfStepsItKeepsTheBestSoFar) {
  std::mt19937 random(2);
  GrowingClique clique(1);
  for (int vertex = 0; vertex < 60; ++vertex) {
    std::vector<bool> row;
    for (int other = 0; other < vertex; ++other) row.push_back(random() % 2);
    clique.add(row);
  }
  EXPECT_FALSE(clique.exact());
  EXPECT_GE(clique.clique().size(), 2u);
}

}  // namespace
}  // namespace lamp
