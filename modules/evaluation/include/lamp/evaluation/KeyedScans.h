#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace lamp::evaluation {

/** Points of the keyed scans of one robot in the base frame, metres, by stamp. */
struct KeyedScans {
  std::map<double, std::vector<Eigen::Vector3f>> by_stamp;
  std::string damage;  ///< what was wrong with the rest of the file; empty if nothing

  /** Null if there is no scan at the stamp. */
  const std::vector<Eigen::Vector3f>* at(double stamp) const;
};

/** Reads keyframes/<robot>.rawlog. A damaged file gives the scans before the damage.
 * \throws std::runtime_error if the file cannot be opened. */
KeyedScans readKeyedScans(const std::string& path);

}  // namespace lamp::evaluation
