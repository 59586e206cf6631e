#include "FrontEndTeam.h"

#include "lamp/frontend/StartPose.h"

namespace lamp {

FrontEndTeam::FrontEndTeam(const SlamConfig& config, MessageSender& sender)
    : config_(config), sender_(sender) {}

FrontEnd& FrontEndTeam::of(RobotId robot) {
  const auto found = front_ends_.find(robot);
  if (found != front_ends_.end()) return found->second;
  // The robots of the ini come first in the robot table, in the ini's order.
  std::optional<StartPrior> prior;
  if (robot.value < config_.robots.size()) {
    bool first = true;
    for (size_t i = 0; i < robot.value; ++i) first = first && config_.robots[i].start_pose.empty();
    prior = startPrior(config_.robots[robot.value], first);
    if (config_.robots[robot.value].startsAtGate())
      gate_starts_.try_emplace(robot, config_.gate, config_.frontend.scan);
  }
  return front_ends_
      .try_emplace(robot, robot, config_.frontend, config_.makeOne<OdometrySource>(),
                   std::move(prior))
      .first->second;
}

bool FrontEndTeam::send(RobotId robot, std::vector<KeyNodePacket> packets) {
  const auto gate = gate_starts_.find(robot);
  if (gate != gate_starts_.end()) packets = gate->second.pass(std::move(packets));
  for (KeyNodePacket& packet : packets)
    if (!sender_.send(std::move(packet))) return false;
  return true;
}

bool FrontEndTeam::observe(const InputObservation& observation) {
  // Time moves on for all: a key node must not wait for its robot's next observation, or the base
  // station would get it after later ones of others.
  for (auto& [robot, front_end] : front_ends_)
    if (robot != observation.robot && !send(robot, front_end.advanceTo(observation.stamp)))
      return false;
  FrontEnd& front_end = of(observation.robot);
  const auto gate = gate_starts_.find(observation.robot);
  if (gate != gate_starts_.end()) gate->second.observe(observation);
  return send(observation.robot, front_end.observe(observation));
}

void FrontEndTeam::finish() {
  for (auto& [robot, front_end] : front_ends_) {
    const auto gate = gate_starts_.find(robot);
    if (gate != gate_starts_.end() && !send(robot, gate->second.finish())) return;
    if (!send(robot, front_end.finish())) return;
    sender_.send(front_end.end());
  }
}

std::vector<FrontEndReport> FrontEndTeam::reports() const {
  std::vector<FrontEndReport> result;
  for (const auto& [robot, front_end] : front_ends_) {
    result.push_back({robot, front_end.counts(), front_end.warnings()});
    const auto gate = gate_starts_.find(robot);
    if (gate == gate_starts_.end()) continue;
    for (const std::string& warning : gate->second.warnings())
      result.back().warnings.push_back(warning);
  }
  return result;
}

}  // namespace lamp
