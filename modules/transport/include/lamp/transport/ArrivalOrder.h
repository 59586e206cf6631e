#pragma once

#include <deque>
#include <limits>
#include <map>

#include "lamp/transport/ArrivalTimes.h"
#include "lamp/transport/Transport.h"

namespace lamp {

/** Plays recorded messages in the order in which the radio link delivers them.
 *
 * Messages of one robot stay in order; between robots the earlier arrival comes first, at equal
 * arrivals the robot with the smaller id. A robot's end follows its last key node. A message is
 * given when the next one of each robot is known, so that no earlier one can come; the others are
 * held here, and the sender's queue never fills up because of them. The order depends on the
 * messages only, not on when they are sent.
 */
class ArrivalOrder : public MessageReceiver {
 public:
  /** \param recorded outlives this. \param arrivals of all robots; robots without any have a link
   * that never breaks. */
  ArrivalOrder(MessageReceiver& recorded, const std::map<RobotId, ArrivalTimes>& arrivals);

  std::optional<Message> receive() override;
  /** Messages that have been recorded and not yet arrived. */
  size_t held() const;

 private:
  struct Held {
    double arrival;
    Message message;
  };
  struct Robot {
    ArrivalTimes times;
    std::deque<Held> held;
    double last_arrival = -std::numeric_limits<double>::infinity();
    bool ended = false;
  };

  bool nextOfAllRobotsIsKnown() const;
  void hold(Message message);
  std::optional<Message> takeEarliest();

  MessageReceiver& recorded_;
  std::map<RobotId, Robot> robots_;
};

}  // namespace lamp
