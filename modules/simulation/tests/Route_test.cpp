#include "lamp/simulation/Route.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "TestLayout.h"

namespace lamp::simulation {
namespace {

using namespace test;
using Route = std::vector<Leg>;

double lengthOf(const Leg& leg) {
  double sum = 0;
  for (size_t i = 1; i < leg.points.size(); ++i)
    sum += (leg.points[i].floor - leg.points[i - 1].floor).norm();
  return sum;
}

double lengthOf(const Route& route) {
  double sum = 0;
  for (const Leg& leg : route) sum += lengthOf(leg);
  return sum;
}

bool isOn(const Passage& passage, const Eigen::Vector3d& p) {
  Layout one;
  one.passages = {passage};
  return one.distanceToPassages(p) < 1e-9;
}

/** Passages of which the route drives at least a metre. */
std::set<size_t> drivenPassages(const Layout& layout, const Route& route) {
  std::set<size_t> driven;
  for (const Leg& leg : route)
    for (size_t i = 1; i < leg.points.size(); ++i) {
      const Eigen::Vector3d &a = leg.points[i - 1].floor, &b = leg.points[i].floor;
      for (size_t k = 0; k < layout.passages.size(); ++k)
        if ((b - a).norm() > 1 && isOn(layout.passages[k], a) && isOn(layout.passages[k], b))
          driven.insert(k);
    }
  return driven;
}

Route onlyRoute(const Layout& layout, double length_m, uint64_t seed) {
  return planRoutes(layout, {length_m}, seed).at(0);
}

bool sameRoute(const Route& a, const Route& b) {
  if (a.size() != b.size()) return false;
  for (size_t i = 0; i < a.size(); ++i) {
    if (a[i].points.size() != b[i].points.size()) return false;
    for (size_t k = 0; k < a[i].points.size(); ++k)
      if (a[i].points[k].floor != b[i].points[k].floor) return false;
  }
  return true;
}

TEST(Route, FollowsConnectedPassagesFromTheGate) {
  const Layout layout = ringLayout();
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const Route route = onlyRoute(layout, 333, seed);
    EXPECT_EQ(route[0].points[0].floor, layout.places[0]);
    for (size_t i = 0; i < route.size(); ++i) {
      ASSERT_GE(route[i].points.size(), 2u);
      if (i > 0) {
        EXPECT_EQ(route[i].points.front().floor, route[i - 1].points.back().floor);
      }
      for (size_t k = 1; k < route[i].points.size(); ++k) {
        const Leg::Point &a = route[i].points[k - 1], &b = route[i].points[k];
        bool along_one = false;
        for (const Passage& passage : layout.passages)
          along_one |= isOn(passage, a.floor) && isOn(passage, b.floor) &&
                       isOn(passage, 0.5 * (a.floor + b.floor)) && b.width_m == passage.width_m;
        EXPECT_TRUE(along_one) << a.floor.transpose() << " to " << b.floor.transpose();
      }
    }
  }
}

TEST(Route, IsAsLongAsAskedAndHeadsHomeInTime) {
  const Layout layout = ringLayout();
  for (const double length : {5.0, 47.0, 120.0, 333.0})
    for (uint64_t seed = 1; seed <= 10; ++seed) {
      const Route route = onlyRoute(layout, length, seed);
      const Eigen::Vector3d end = route.back().points.back().floor;
      EXPECT_LE(lengthOf(route), length + 1e-6);
      if (end != layout.places[0]) {
        EXPECT_NEAR(lengthOf(route), length, 1e-6);
      }
      EXPECT_LT(end.norm(), 2 * 20.0 + 1e-6) << "two passages from the gate at most";
    }
}

TEST(Route, TurnsBackAtADeadEndWithANewLeg) {
  const Route route = onlyRoute(deadEndLayout(), 34, 1);
  ASSERT_EQ(route.size(), 4u);
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(lengthOf(route[i]), 10, 1e-9);
  EXPECT_NEAR(lengthOf(route[3]), 4, 1e-9);
  EXPECT_EQ(route[1].points.front().floor, Eigen::Vector3d(10, 0, 0));
  EXPECT_EQ(route[2].points.front().floor, Eigen::Vector3d(0, 0, 0));
}

TEST(Route, DrivesForwardsWithinALeg) {
  size_t bends = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed)
    for (const Leg& leg : onlyRoute(ringLayout(), 333, seed))
      for (size_t i = 2; i < leg.points.size(); ++i) {
        const Eigen::Vector3d before = leg.points[i - 1].floor - leg.points[i - 2].floor;
        const Eigen::Vector3d after = leg.points[i].floor - leg.points[i - 1].floor;
        EXPECT_GT(before.dot(after), -0.9 * before.norm() * after.norm());
        ++bends;
      }
  EXPECT_GT(bends, 100u) << "there are some to look at";
}

TEST(Route, ExploresAllAndClosesLoops) {
  const Layout layout = ringLayout();
  for (uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(drivenPassages(layout, onlyRoute(layout, 300, seed)).size(), layout.passages.size());
}

TEST(Route, RobotsOfATeamOverlapButShareTheWork) {
  const Layout layout = ringLayout();
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const auto routes = planRoutes(layout, {90, 90, 90}, seed);
    std::set<size_t> all;
    for (const Route& route : routes) {
      const std::set<size_t> driven = drivenPassages(layout, route);
      EXPECT_EQ(driven.count(0), 1u) << "all come through the gate";
      all.insert(driven.begin(), driven.end());
    }
    EXPECT_GE(all.size(), 5u);
  }
}

TEST(Route, PlansForATeamOfSixteen) {
  const Layout layout = ringLayout();
  const auto routes = planRoutes(layout, std::vector<double>(16, 90.0), 3);
  ASSERT_EQ(routes.size(), 16u);
  for (const Route& route : routes) {
    EXPECT_EQ(route[0].points[0].floor, layout.places[0]);
    EXPECT_GE(lengthOf(route), 60);
  }
  EXPECT_FALSE(std::all_of(routes.begin(), routes.end(),
                           [&](const Route& route) { return sameRoute(route, routes[0]); }));
}

TEST(Route, TheSeedDecidesTheRoutes) {
  const Layout layout = ringLayout();
  const Route one = onlyRoute(layout, 300, 1);
  EXPECT_TRUE(sameRoute(one, onlyRoute(layout, 300, 1)));
  int different = 0;
  for (uint64_t seed = 2; seed <= 9; ++seed)
    different += !sameRoute(one, onlyRoute(layout, 300, seed));
  EXPECT_GE(different, 4);
}

TEST(Route, AGateWithoutPassagesIsAFault) {
  Layout layout;
  layout.places = {{0, 0, 0}};
  EXPECT_THROW(planRoutes(layout, {10}, 1), std::logic_error);
}

}  // namespace
}  // namespace lamp::simulation
