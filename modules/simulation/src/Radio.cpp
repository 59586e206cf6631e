#include "lamp/simulation/Radio.h"

#include <algorithm>
#include <cmath>

#include "SampleStamps.h"
#include "lamp/simulation/Random.h"

namespace lamp::simulation {

void RadioOptions::visit(OptionVisitor& v) {
  v("beacon_spacing_m", beacon_spacing_m, "m", "way after which a robot drops a beacon", kPositive);
  v("rate_hz", rate_hz, "Hz", "readings of each beacon per second", kPositive);
  v("range_m", range_m, "m", "farthest beacon that is heard", kPositive);
  v("antenna_m", antenna_m, "m", "height of antennas above the base", kNotNegative);
  v("loss_at_1m_db", loss_at_1m_db, "dB", "path loss over the first metre", kNotNegative);
  v("exponent", exponent, "", "path loss grows by 10 times this per tenfold distance",
    kNotNegative);
  v("wall_loss_db", wall_loss_db, "dB", "path loss without line of sight, more", kNotNegative);
  v("shadowing_db", shadowing_db, "dB", "random part of the path loss", kNotNegative);
  v("max_loss_db", max_loss_db, "dB", "path loss beyond which nothing is heard", kPositive);
}

std::vector<Beacon> dropBeacons(const TrajectoryInterpolator& truth, const std::string& robot,
                                double spacing_m) {
  constexpr double kRate_hz = 5;
  std::vector<Beacon> beacons;
  double way_m = 0;
  Eigen::Vector3d last = truth.at(truth.begin()).translation();
  for (const double stamp : sampleStamps(truth, kRate_hz)) {
    const Eigen::Vector3d position = truth.at(stamp).translation();
    way_m += (position - last).norm();
    last = position;
    if (way_m < spacing_m) continue;
    beacons.push_back({robot + "-" + std::to_string(beacons.size()), position, stamp});
    way_m = 0;
  }
  return beacons;
}

Radio::Radio(RadioOptions options, const RayCaster& caster)
    : options_(std::move(options)), caster_(caster) {}

double Radio::expectedLoss(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  constexpr double kNearest_m = 0.3;  // antennas do not come closer
  const Eigen::Vector3d up(0, 0, options_.antenna_m);
  const double distance = std::max(kNearest_m, (to - from).norm());
  const double loss = options_.loss_at_1m_db + 10.0 * options_.exponent * std::log10(distance);
  const bool visible = caster_.visible((from + up).cast<float>(), (to + up).cast<float>());
  return visible ? loss : loss + options_.wall_loss_db;
}

std::vector<RssiReading> Radio::listen(const TrajectoryInterpolator& truth,
                                       const std::vector<Beacon>& beacons, uint64_t seed) const {
  Random random(mixSeeds({seed}));
  std::vector<RssiReading> readings;
  for (const double stamp : sampleStamps(truth, options_.rate_hz)) {
    const Eigen::Vector3d position = truth.at(stamp).translation();
    for (size_t i = 0; i < beacons.size(); ++i) {
      if (beacons[i].since > stamp) continue;
      if ((beacons[i].position - position).norm() > options_.range_m) continue;
      const double loss =
          expectedLoss(beacons[i].position, position) + normal(random, options_.shadowing_db);
      if (loss <= options_.max_loss_db) readings.push_back({stamp, i, loss});
    }
  }
  return readings;
}

}  // namespace lamp::simulation
