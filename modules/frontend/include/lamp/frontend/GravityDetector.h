#pragma once

#include <deque>
#include <optional>

#include "lamp/core/KeyNodePacket.h"
#include "lamp/core/Options.h"
#include "lamp/input/ExtrasFromObservation.h"

namespace lamp {

struct GravityOptions {
  double gravity_window_s = 2.0;
  double gravity_max_turn_rad_s = 0.025;
  double gravity_max_change_m_s2 = 0.1;
  double gravity_max_shake_m_s2 = 0.4;
  double gravity_sigma_deg = 1.0;

  void visit(OptionVisitor& v);
};

/** Tells gravity's direction from an inertial unit that stands, as LAMP does: it does not turn,
 * does not shake as a robot that drives over ground does, both halves of a window feel the same
 * force, and that force is as strong as gravity. */
class GravityDetector {
 public:
  explicit GravityDetector(const GravityOptions& options) : options_(options) {}

  /** \param stamp seconds, UTC; readings that do not increase it are ignored.
   *  \return what points up, at `stamp`, if the window that ends there tells. */
  std::optional<GravityReading> observe(double stamp, const InertialReading& reading);

 private:
  struct Sample {
    double stamp;
    InertialReading reading;
  };

  const GravityOptions options_;
  std::deque<Sample> window_;
};

}  // namespace lamp
