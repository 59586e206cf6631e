#include "lamp/simulation/Link.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace lamp::simulation {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

void LinkOptions::visit(OptionVisitor& v) {
  v("range_m", range_m, "m", "reach of a radio in line of sight", kPositive);
  v("range_without_sight_m", range_without_sight_m, "m", "reach of a radio through walls",
    kNotNegative);
  v("antenna_m", antenna_m, "m", "height of antennas above the base", kNotNegative);
  v("messages_per_s", messages_per_s, "1/s", "key nodes that a link carries", kPositive);
  v("check_s", check_s, "s", "time between two looks for a lost link", kPositive);
}

Link::Link(LinkOptions options, const RayCaster& caster, const Eigen::Vector3d& base,
           const std::vector<Beacon>& beacons)
    : options_(std::move(options)), caster_(caster), relays_{{base, -kNever}} {
  if (!(options_.check_s > 0 && options_.messages_per_s > 0))
    throw std::runtime_error("link: check_s and messages_per_s must be positive");
  joinBeacons(beacons);
}

bool Link::reaches(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
  const double distance = (a - b).norm();
  if (distance <= options_.range_without_sight_m) return true;
  if (distance > options_.range_m) return false;
  const Eigen::Vector3d up(0, 0, options_.antenna_m);
  return caster_.visible((a + up).cast<float>(), (b + up).cast<float>());
}

/** Dijkstra's algorithm from the base, where the length of a chain is the time at which its last
 * radio was dropped. */
void Link::joinBeacons(const std::vector<Beacon>& beacons) {
  std::vector<double> since(beacons.size(), kNever);
  std::vector<bool> joined(beacons.size(), false);
  const auto relax = [&](const Relay& from) {
    for (size_t i = 0; i < beacons.size(); ++i) {
      const double candidate = std::max(from.connected_since, beacons[i].since);
      if (!joined[i] && candidate < since[i] && reaches(from.position, beacons[i].position))
        since[i] = candidate;
    }
  };
  relax(relays_.front());
  for (size_t round = 0; round < beacons.size(); ++round) {
    size_t next = beacons.size();
    for (size_t i = 0; i < beacons.size(); ++i)
      if (!joined[i] && since[i] < (next < beacons.size() ? since[next] : kNever)) next = i;
    if (next == beacons.size()) return;
    joined[next] = true;
    relays_.push_back({beacons[next].position, since[next]});
    relax(relays_.back());
  }
}

bool Link::connected(double stamp, const Eigen::Vector3d& position) const {
  return std::any_of(relays_.begin(), relays_.end(), [&](const Relay& relay) {
    return relay.connected_since <= stamp && reaches(relay.position, position);
  });
}

double Link::nextContact(double stamp, const TrajectoryInterpolator& truth,
                         double recovered) const {
  // After the end the robot stands still, but a relay may still come near.
  for (double t = stamp; t < recovered; t += options_.check_s)
    if (connected(t, truth.at(t).translation())) return t;
  return std::max(stamp, recovered);
}

std::vector<double> Link::arrivalTimes(const std::vector<double>& stamps,
                                       const TrajectoryInterpolator& truth,
                                       double recovered) const {
  std::vector<double> arrivals;
  arrivals.reserve(stamps.size());
  double free_from = -kNever;  // when the link can carry the next message
  for (const double stamp : stamps) {
    const double ready = std::max(stamp, std::min(free_from, recovered));
    const double arrival = nextContact(ready, truth, recovered);
    arrivals.push_back(arrival);
    free_from = arrival + (arrival < recovered ? 1.0 / options_.messages_per_s : 0.0);
  }
  return arrivals;
}

}  // namespace lamp::simulation
