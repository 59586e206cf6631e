#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace lamp::simulation {

/** Smooth random field in space: gradient noise (Perlin, "Improving Noise", SIGGRAPH 2002), about
 * -0.7 to 0.7, zero at lattice points, features about `wavelength_m` apart. The same for the same
 * seed. */
class Noise {
 public:
  explicit Noise(uint64_t seed) : seed_(seed) {}
  double at(const Eigen::Vector3d& p, double wavelength_m) const;
  /** Sum of `octaves` fields, each of half the wavelength and half the height of the one before;
   * the first has height one. */
  double fractal(const Eigen::Vector3d& p, double wavelength_m, int octaves) const;

 private:
  double corner(int x, int y, int z, const Eigen::Vector3d& offset) const;
  uint64_t seed_;
};

}  // namespace lamp::simulation
