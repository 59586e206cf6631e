#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "lamp/frontend/RecordedOdometry.h"
#include "lamp/input/ObservationSource.h"

namespace lamp {

class ApertureCheck;

/** Looks at the beginning of a robot's recording for a 2D laser whose field of view is recorded
 * wrongly: turning shows what it really is. */
class ApertureSurvey {
 public:
  ApertureSurvey();
  ~ApertureSurvey();
  ApertureSurvey(ApertureSurvey&&) noexcept;

  /** The robot's observations in time order. */
  void observe(const InputObservation& observation);
  /** True once enough has been seen. */
  bool decided() const;
  /** The field of view as recorded and as it is, degrees, if they contradict one another. What is
   * measured to some percent stands for the nearest usual one. */
  struct Correction {
    double recorded_deg = 0, seen_deg = 0, corrected_deg = 0;
  };
  std::optional<Correction> correction() const;

 private:
  RecordedOdometry odometry_;
  std::unique_ptr<ApertureCheck> check_;
  std::optional<std::string> label_;  ///< of the first laser
  std::deque<InputObservation> waiting_;
};

}  // namespace lamp
