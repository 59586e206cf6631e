#include "lamp/simulation/Lidar.h"

namespace lamp::simulation {

void LidarOptions::visit(OptionVisitor& v) {
  v("model", model, "a spinning lidar, or one whose mount rotates too",
    {"spinning", "rotating_mount"});
  v("pose", pose, 6, "", "base_T_sensor (or of the mount): [x y z yaw_deg pitch_deg roll_deg]");
  v("rate_hz", rate_hz, "Hz", "revolutions per second", Range{1, 20});
  v("azimuth_steps", azimuth_steps, "",
    "firing sequences of 16 lasers a revolution; a VLP-16 has 1800 at 10 Hz", Range{12, 7200});
  v("sequences_per_block", sequences_per_block, "",
    "2 fills a block of a packet as a VLP-16 does, but MRPT 2.5.8 reads only the first of the two",
    Range{1, 2});
  v("range_sigma_m", range_sigma_m, "m", "noise of a range", kNotNegative);
  v("min_range_m", min_range_m, "m", "what is nearer gives no return", kNotNegative);
  v("max_range_m", max_range_m, "m", "range at which a rock wall just returns the light",
    Range{1, 130});
  v("dropout", dropout, "", "share of returns that are lost for no reason", kShare);
  v("grazing_deg", grazing_deg, "deg",
    "incidence beyond which near surfaces fade; far and dark ones do so earlier", Range{0, 89});
  v("intensity_sigma", intensity_sigma, "", "noise of an intensity (0 to 1)", kNotNegative);
  v("dust_per_m", dust_per_m, "1/m", "chance of a return from dust, per metre of the ray, at worst",
    kNotNegative);
  v("dust_share", dust_share, "", "share of the time in which there is dust", kShare);
  v("dust_patch_s", dust_patch_s, "s", "time in which a cloud of dust rises and settles",
    kPositive);
  v("mount_rate_hz", mount_rate_hz, "Hz", "rotating mount: turns per second");
  v("mount_tilt_deg", mount_tilt_deg, "deg",
    "rotating mount: angle between its axis and that of the lidar");
  v("packets_per_observation", packets_per_observation, "",
    "rotating mount: packets of 12 blocks that share one sensor pose", Range{1, 75});
}

}  // namespace lamp::simulation
