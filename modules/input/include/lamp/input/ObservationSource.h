#pragma once

#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

#include "lamp/core/Ids.h"

namespace lamp {

/** One observation of one robot. `label` is the sensor label without the robot's part. */
struct InputObservation {
  RobotId robot;
  std::string label;
  double stamp = 0;  ///< seconds, UTC
  mrpt::obs::CObservation::Ptr observation;
};

/** A time-ordered stream of observations of any number of robots. */
class ObservationSource {
 public:
  virtual ~ObservationSource() = default;
  /** The next observation, or none at the end. */
  virtual std::optional<InputObservation> next() = 0;
  /** Share of the input that has been read, 0 to 1, for progress only. */
  virtual double progress() const = 0;
};

}  // namespace lamp
