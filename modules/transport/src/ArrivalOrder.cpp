#include "lamp/transport/ArrivalOrder.h"

#include <algorithm>

namespace lamp {

ArrivalOrder::ArrivalOrder(MessageReceiver& recorded,
                           const std::map<RobotId, ArrivalTimes>& arrivals)
    : recorded_(recorded) {
  for (const auto& [robot, times] : arrivals) robots_[robot].times = times;
}

std::optional<Message> ArrivalOrder::receive() {
  while (!nextOfAllRobotsIsKnown()) {
    if (auto message = recorded_.receive())
      hold(std::move(*message));
    else
      for (auto& [id, robot] : robots_) robot.ended = true;
  }
  return takeEarliest();
}

size_t ArrivalOrder::held() const {
  size_t sum = 0;
  for (const auto& [id, robot] : robots_) sum += robot.held.size();
  return sum;
}

bool ArrivalOrder::nextOfAllRobotsIsKnown() const {
  return std::all_of(robots_.begin(), robots_.end(), [](const auto& entry) {
    return entry.second.ended || !entry.second.held.empty();
  });
}

void ArrivalOrder::hold(Message message) {
  if (const auto* packet = std::get_if<KeyNodePacket>(&message)) {
    Robot& robot = robots_[packet->id.robot];
    // Stamps that go back, in a damaged recording, must not change a robot's own order.
    robot.last_arrival = std::max(robot.last_arrival, robot.times.at(packet->stamp));
    robot.held.push_back({robot.last_arrival, std::move(message)});
  } else {
    Robot& robot = robots_[std::get<RobotEnd>(message).robot];
    robot.ended = true;
    robot.held.push_back({robot.last_arrival, std::move(message)});
  }
}

std::optional<Message> ArrivalOrder::takeEarliest() {
  Robot* earliest = nullptr;
  for (auto& [id, robot] : robots_) {
    if (robot.held.empty()) continue;
    if (!earliest || robot.held.front().arrival < earliest->held.front().arrival) earliest = &robot;
  }
  if (!earliest) return std::nullopt;
  Message message = std::move(earliest->held.front().message);
  earliest->held.pop_front();
  return message;
}

}  // namespace lamp
