#include "lamp/simulation/Movers.h"

namespace lamp::simulation {

void MoverOptions::visit(OptionVisitor& v) {
  v("people", people, "", "people who walk about", {0, 500});
  v("vehicles", vehicles, "", "vehicles that drive about", {0, 500});
  v("person_speed_mps", person_speed_mps, "m/s", "how fast people walk", {0.1, 5});
  v("vehicle_speed_mps", vehicle_speed_mps, "m/s", "how fast vehicles drive", {0.1, 20});
  v("stop_share", stop_share, "", "share of the places on their way at which they stop", kShare);
  v("stop_s", stop_s, "s", "for about so long", kNotNegative);
}

}  // namespace lamp::simulation
