#include "Dust.h"

#include <cmath>

namespace lamp::simulation {

double dustPerMetre(const LidarOptions& options, double stamp, uint64_t seed) {
  constexpr uint64_t kStream = 0xd057;
  const double patch = std::floor(stamp / options.dust_patch_s);
  Random random(mixSeeds({seed, kStream, static_cast<uint64_t>(static_cast<int64_t>(patch))}));
  if (!chance(random, options.dust_share)) return 0.0;
  const double rise = std::sin(M_PI * (stamp / options.dust_patch_s - patch));
  return options.dust_per_m * rise * rise;
}

}  // namespace lamp::simulation
