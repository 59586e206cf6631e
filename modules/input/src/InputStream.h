#pragma once

#include "lamp/input/InputReport.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

/** Observations of one file in time order. */
class InputStream {
 public:
  virtual ~InputStream() = default;
  /** Stamp of the next observation, or none at the end. */
  virtual std::optional<double> nextStamp() = 0;
  /** Only after nextStamp() gave a stamp. */
  virtual InputObservation pop() = 0;
  /** Share of the file that was read, 0 to 1. */
  virtual double progress() const = 0;
  /** None if the stream is no recording. */
  virtual std::optional<RecordingReport> report() const = 0;
};

}  // namespace lamp
