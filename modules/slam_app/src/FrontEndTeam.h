#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "lamp/frontend/ApertureSurvey.h"
#include "lamp/frontend/FrontEnd.h"
#include "lamp/frontend/GateStart.h"
#include "lamp/slam_app/RunWriter.h"
#include "lamp/slam_app/SlamConfig.h"
#include "lamp/transport/Transport.h"

namespace lamp {

/** The front ends of all robots, made as the robots appear in the input. */
class FrontEndTeam {
 public:
  /** \param apertures of 2D lasers that are recorded wrongly. */
  FrontEndTeam(const SlamConfig& config, MessageSender& sender,
               std::map<RobotId, ApertureSurvey::Correction> apertures = {});

  /** Takes the team's observations in time order.
   *  \return false if nobody receives the key nodes any more. */
  bool observe(const InputObservation& observation);
  /** Flushes what waits and closes the robots' streams. */
  void finish();
  std::vector<FrontEndReport> reports() const;

 private:
  FrontEnd& of(RobotId robot);
  bool send(RobotId robot, std::vector<KeyNodePacket> packets);

  const SlamConfig& config_;
  MessageSender& sender_;
  const std::map<RobotId, ApertureSurvey::Correction> apertures_;
  std::map<RobotId, FrontEnd> front_ends_;
  std::map<RobotId, GateStart> gate_starts_;  ///< of robots that start at the gate
};

}  // namespace lamp
