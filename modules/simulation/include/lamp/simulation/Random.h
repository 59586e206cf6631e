#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>

namespace lamp::simulation {

using Random = std::mt19937_64;

/** A seed for one of many independent streams, e.g. {world seed, robot, scan}: what one part draws
 * does not depend on what others drew before, nor on threads. */
uint64_t mixSeeds(std::initializer_list<uint64_t> parts);

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
inline double normal(Random& random, double sigma) {
  return sigma > 0 ? std::normal_distribution<double>(0.0, sigma)(random) : 0.0;
}
inline bool chance(Random& random, double probability) {
  return uniform(random, 0.0, 1.0) < probability;
}
/** Uniform among 0 .. count-1. */
inline size_t pick(Random& random, size_t count) {
  return std::uniform_int_distribution<size_t>(0, count - 1)(random);
}

}  // namespace lamp::simulation
