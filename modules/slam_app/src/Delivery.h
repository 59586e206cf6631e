#pragma once

#include <algorithm>
#include <optional>

#include "TeamArrivals.h"
#include "lamp/slam_app/SlamConfig.h"
#include "lamp/transport/ArrivalOrder.h"

namespace lamp {

/** Gives the base station what the front ends send, in the order that the ini asks for. */
class Delivery {
 public:
  /** \param queue outlives this. \throws std::runtime_error if an arrivals file is wrong. */
  Delivery(const SlamConfig& config, MessageReceiver& queue) : queue_(queue) {
    if (config.input.inArrivalOrder()) by_arrival_.emplace(queue, readTeamArrivals(config));
  }

  std::optional<Message> receive() {
    auto message = by_arrival_ ? by_arrival_->receive() : queue_.receive();
    received_ += message ? 1 : 0;
    return message;
  }

  /** Share of the messages sent so far that were received; 1 where none is held back. */
  double share() const {
    const double held = by_arrival_ ? static_cast<double>(by_arrival_->held()) : 0;
    return received_ / std::max(received_ + held, 1.0);
  }

 private:
  MessageReceiver& queue_;
  std::optional<ArrivalOrder> by_arrival_;
  double received_ = 0;
};

}  // namespace lamp
