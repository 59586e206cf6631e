#include "lamp/simulation/FiringPattern.h"

#include <array>
#include <cmath>

namespace lamp::simulation {
namespace {

/** By laser id, which is also the order of firing (VLP-16 manual, 63-9243, table 9-1). */
constexpr std::array<int, FiringPattern::kLasers> kElevations_deg = {
    -15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15};
/** A laser fires 2.304 us after the one before, and a block lasts 110.592 us. */
constexpr double kLasersPerBlockTime = 48.0;

struct SineCosine {
  float sine, cosine;
};

std::array<SineCosine, FiringPattern::kLasers> elevationTable() {
  std::array<SineCosine, FiringPattern::kLasers> table;
  for (int laser = 0; laser < FiringPattern::kLasers; ++laser) {
    const double e = FiringPattern::elevation(laser);
    table[laser] = {static_cast<float>(std::sin(e)), static_cast<float>(std::cos(e))};
  }
  return table;
}

}  // namespace

FiringPattern::FiringPattern(int sequences, double rate_hz, int sequences_per_block)
    : sequences_(sequences),
      sequences_per_block_(sequences_per_block),
      rate_hz_(rate_hz),
      sequence_s_(1.0 / (rate_hz * sequences)),
      laser_s_(sequence_s_ * sequences_per_block / kLasersPerBlockTime) {}

double FiringPattern::azimuth(int sequence, int laser) const {
  return 2.0 * M_PI * rate_hz_ * delay(sequence, laser);
}

Eigen::Vector3f FiringPattern::direction(int sequence, int laser) const {
  static const auto elevations = elevationTable();
  const auto [sine, cosine] = elevations[laser];
  const auto a = static_cast<float>(azimuth(sequence, laser));
  return {cosine * std::cos(a), -cosine * std::sin(a), sine};
}

double FiringPattern::elevation(int laser) {
  return kElevations_deg[laser] * M_PI / 180.0;
}

}  // namespace lamp::simulation
