#include "FrontEndTeam.h"

#include <cmath>

#include "lamp/frontend/StartPose.h"

namespace lamp {

namespace {

std::string describe(const ApertureSurvey::Correction& aperture) {
  const auto degrees = [](double value) { return std::to_string(std::lround(value)); };
  return "the 2D laser's field of view is recorded as " + degrees(aperture.recorded_deg) +
         " deg, but its scans turn against odometry as if it were about " +
         degrees(aperture.seen_deg) + " deg: it is taken to be " + degrees(aperture.corrected_deg) +
         " deg; [frontend] laser_aperture_deg overrides this";
}

}  // namespace

FrontEndTeam::FrontEndTeam(const SlamConfig& config, MessageSender& sender,
                           std::map<RobotId, ApertureSurvey::Correction> apertures)
    : config_(config), sender_(sender), apertures_(std::move(apertures)) {}

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
  FrontEndOptions options = config_.frontend;
  const auto aperture = apertures_.find(robot);
  if (aperture != apertures_.end())
    options.scan.laser_aperture_deg = aperture->second.corrected_deg;
  return front_ends_
      .try_emplace(robot, robot, options, config_.make<OdometrySource>(), std::move(prior))
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
    const auto aperture = apertures_.find(robot);
    if (aperture != apertures_.end()) result.back().warnings.push_back(describe(aperture->second));
    const auto gate = gate_starts_.find(robot);
    if (gate == gate_starts_.end()) continue;
    for (const std::string& warning : gate->second.warnings())
      result.back().warnings.push_back(warning);
  }
  return result;
}

}  // namespace lamp
