#include "lamp/simulation/Noise.h"

#include <cmath>

namespace lamp::simulation {

namespace {

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

}  // namespace

/** Contribution of one lattice point: its random gradient times the offset from it. */
double Noise::corner(int x, int y, int z, const Eigen::Vector3d& offset) const {
  uint64_t h = seed_ ^ (static_cast<uint64_t>(static_cast<uint32_t>(x)) * 0x9e3779b185ebca87ULL) ^
               (static_cast<uint64_t>(static_cast<uint32_t>(y)) * 0xc2b2ae3d27d4eb4fULL) ^
               (static_cast<uint64_t>(static_cast<uint32_t>(z)) * 0x165667b19e3779f9ULL);
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ULL;
  h ^= h >> 32;
  // The twelve edges of a cube, some of them twice.
  const double u = (h & 15) < 8 ? offset.x() : offset.y();
  const double v = (h & 15) < 4                         ? offset.y()
                   : ((h & 15) == 12 || (h & 15) == 14) ? offset.x()
                                                        : offset.z();
  return ((h & 16) ? -u : u) + ((h & 32) ? -v : v);
}

double Noise::at(const Eigen::Vector3d& p, double wavelength_m) const {
  const Eigen::Vector3d q = p / wavelength_m;
  const Eigen::Vector3d base = q.array().floor();
  const Eigen::Vector3d f = q - base;
  const int x = static_cast<int>(base.x()), y = static_cast<int>(base.y()),
            z = static_cast<int>(base.z());
  const double u = fade(f.x()), v = fade(f.y()), w = fade(f.z());
  const auto at_corner = [&](int i, int j, int k) {
    return corner(x + i, y + j, z + k, f - Eigen::Vector3d(i, j, k));
  };
  const auto along_x = [&](int j, int k) { return mix(at_corner(0, j, k), at_corner(1, j, k), u); };
  return mix(mix(along_x(0, 0), along_x(1, 0), v), mix(along_x(0, 1), along_x(1, 1), v), w);
}

double Noise::fractal(const Eigen::Vector3d& p, double wavelength_m, int octaves) const {
  double sum = 0, height = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    // Shifted, or all octaves would vanish together at the lattice points of the first.
    sum += height * at(p + Eigen::Vector3d::Constant(37.7 * octave), wavelength_m);
    wavelength_m /= 2;
    height /= 2;
  }
  return sum;
}

}  // namespace lamp::simulation
