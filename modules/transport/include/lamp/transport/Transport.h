#pragma once

#include <optional>
#include <variant>

#include "lamp/core/KeyNodePacket.h"

namespace lamp {

/** What travels from the robots to the base station. */
using Message = std::variant<KeyNodePacket, RobotEnd>;

/** The robots' end of the link. */
class MessageSender {
 public:
  virtual ~MessageSender() = default;
  /** \return false if nobody will ever receive it, so that the sender can stop. */
  virtual bool send(Message message) = 0;
};

/** The base station's end of the link. */
class MessageReceiver {
 public:
  virtual ~MessageReceiver() = default;
  /** Waits for the next message; none when all senders are done. */
  virtual std::optional<Message> receive() = 0;
};

}  // namespace lamp
