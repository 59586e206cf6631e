#include "lamp/simulation/Route.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <stdexcept>

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

/** A passage and the direction in which it is driven. */
struct Step {
  size_t passage;
  bool forwards;
};

size_t endOf(const Layout& layout, const Step& step) {
  const Passage& passage = layout.passages[step.passage];
  return step.forwards ? passage.to : passage.from;
}

/** For each place the distance from the gate, and the step that leads towards it (Dijkstra). */
class WayHome {
 public:
  explicit WayHome(const Layout& layout)
      : distance_(layout.places.size(), std::numeric_limits<double>::infinity()),
        step_(layout.places.size()) {
    using Entry = std::pair<double, size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    distance_[layout.gate] = 0;
    queue.emplace(0.0, layout.gate);
    while (!queue.empty()) {
      const auto [distance, place] = queue.top();
      queue.pop();
      if (distance > distance_[place]) continue;
      for (const size_t i : layout.passagesAt(place)) {
        const Passage& passage = layout.passages[i];
        const size_t other = passage.from == place ? passage.to : passage.from;
        const double through = distance + passage.length();
        if (through >= distance_[other]) continue;
        distance_[other] = through;
        step_[other] = {i, passage.from == other};
        queue.emplace(through, other);
      }
    }
  }

  double distance(size_t place) const { return distance_[place]; }
  Step step(size_t place) const { return step_[place]; }

 private:
  std::vector<double> distance_;
  std::vector<Step> step_;
};

/** Plans one robot's way after the other; later robots know where the earlier ones were. */
class RoutePlanner {
 public:
  RoutePlanner(const Layout& layout, uint64_t seed)
      : layout_(layout), home_(layout), team_visits_(layout.passages.size(), 0), random_(seed) {}

  std::vector<Step> plan(double length_m) {
    std::vector<int> visits(layout_.passages.size(), 0);
    std::vector<Step> steps;
    size_t place = layout_.gate;
    double length = 0;
    bool returning = false;
    while (length < length_m) {
      const bool home = place == layout_.gate;
      returning = !home && (returning || length + home_.distance(place) >= length_m);
      const Step step = returning ? home_.step(place) : explore(place, steps, visits);
      steps.push_back(step);
      ++visits[step.passage];
      length += layout_.passages[step.passage].length();
      place = endOf(layout_, step);
      if (returning && place == layout_.gate) break;
    }
    for (size_t i = 0; i < visits.size(); ++i) team_visits_[i] += visits[i];
    return steps;
  }

 private:
  Step explore(size_t place, const std::vector<Step>& steps, const std::vector<int>& visits) {
    Step best{};
    double least = std::numeric_limits<double>::infinity();
    for (const size_t i : layout_.passagesAt(place)) {
      const bool back = !steps.empty() && steps.back().passage == i;
      const double cost =
          visits[i] + 0.4 * team_visits_[i] + (back ? 10.0 : 0.0) + uniform(random_, 0.0, 0.5);
      if (cost >= least) continue;
      least = cost;
      best = {i, layout_.passages[i].from == place};
    }
    return best;
  }

  const Layout& layout_;
  const WayHome home_;
  std::vector<int> team_visits_;
  Random random_;
};

/** Cuts the steps into legs at reversals, and the last leg at the given length. */
std::vector<Leg> legsOf(const Layout& layout, const std::vector<Step>& steps, double length_m) {
  std::vector<Leg> legs(1);
  double length = 0;
  for (size_t s = 0; s < steps.size(); ++s) {
    const Passage& passage = layout.passages[steps[s].passage];
    if (s > 0 && steps[s - 1].passage == steps[s].passage) legs.emplace_back();
    std::vector<Vector3d> floor = passage.floor;
    if (!steps[s].forwards) std::reverse(floor.begin(), floor.end());
    auto& points = legs.back().points;
    for (const Vector3d& point : floor) {
      if (!points.empty()) {
        const Vector3d last = points.back().floor;
        const double way = (point - last).norm();
        if (way < 1e-6) continue;
        if (length + way > length_m) {
          points.push_back({last + (point - last) * (length_m - length) / way, passage.width_m});
          return legs;
        }
        length += way;
      }
      points.push_back({point, passage.width_m});
    }
  }
  return legs;
}

}  // namespace

std::vector<std::vector<Leg>> planRoutes(const Layout& layout, const std::vector<double>& length_m,
                                         uint64_t seed) {
  if (layout.passagesAt(layout.gate).empty())
    throw std::logic_error("planRoutes: no passage leaves the gate");
  RoutePlanner planner(layout, seed);
  std::vector<std::vector<Leg>> routes;
  for (const double length : length_m)
    routes.push_back(legsOf(layout, planner.plan(length), length));
  return routes;
}

}  // namespace lamp::simulation
