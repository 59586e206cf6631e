#pragma once

#include <vector>

#include "lamp/simulation/Radio.h"

namespace lamp::simulation {

struct LinkOptions {
  double range_m = 60;
  double range_without_sight_m = 8;
  double antenna_m = 0.4;
  double messages_per_s = 5;
  double check_s = 0.5;

  void visit(OptionVisitor& v);
};

/** The way of key nodes to the base station: directly or over dropped beacons, which relay once
 * they are joined to the base by a chain of radios in reach of each other. */
class Link {
 public:
  /** \param base position of the base station, world. \param beacons of all robots.
   *  \param caster must outlive the link. \throws std::runtime_error for options out of range. */
  Link(LinkOptions options, const RayCaster& caster, const Eigen::Vector3d& base,
       const std::vector<Beacon>& beacons);

  bool connected(double stamp, const Eigen::Vector3d& position) const;

  /** When each message of a robot reaches the base. Messages wait in a queue while the robot is out
   * of reach and are sent in order, `messages_per_s` of them, once it is back. What is left at the
   * end arrives when the robots are recovered, in order, all at the same time.
   * \param stamps of the messages, sorted. \param recovered stamp at the end of the mission.
   * \return one stamp a message, sorted, none before its message. */
  std::vector<double> arrivalTimes(const std::vector<double>& stamps,
                                   const TrajectoryInterpolator& truth, double recovered) const;

 private:
  struct Relay {
    Eigen::Vector3d position;
    double connected_since;
  };
  bool reaches(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const;
  void joinBeacons(const std::vector<Beacon>& beacons);
  /** The first time from `stamp` on at which the robot is connected; looks every `check_s`. */
  double nextContact(double stamp, const TrajectoryInterpolator& truth, double recovered) const;

  LinkOptions options_;
  const RayCaster& caster_;
  std::vector<Relay> relays_;  ///< the base, then the beacons that ever join it
};

}  // namespace lamp::simulation
