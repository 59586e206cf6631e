#include "lamp/transport/InProcessQueue.h"

#include <gtest/gtest.h>

#include <thread>

namespace lamp {
namespace {

KeyNodePacket packet(uint32_t index) {
  KeyNodePacket result;
  result.id = {RobotId{0}, index};
  return result;
}

TEST(InProcessQueue, KeepsOrderAcrossThreads) {
  constexpr uint32_t kMessages = 1000;
  InProcessQueue queue(3);
  std::thread sender([&] {
    for (uint32_t i = 0; i < kMessages; ++i) queue.send(packet(i));
    queue.send(RobotEnd{RobotId{0}, {}});
    queue.closeSender();
  });
  uint32_t expected = 0;
  bool ended = false;
  while (const auto message = queue.receive()) {
    if (const auto* p = std::get_if<KeyNodePacket>(&*message)) {
      EXPECT_EQ(p->id.index, expected++);
    } else {
      ended = true;
    }
  }
  sender.join();
  EXPECT_EQ(expected, kMessages);
  EXPECT_TRUE(ended);
}

TEST(InProcessQueue, ReceivesNothingFromAClosedEmptyQueue) {
  InProcessQueue queue(1);
  queue.closeSender();
  EXPECT_FALSE(queue.receive().has_value());
}

TEST(InProcessQueue, ABlockedSenderWakesWhenTheReceiverGoes) {
  InProcessQueue queue(1);
  EXPECT_TRUE(queue.send(packet(0)));
  bool accepted = true;
  std::thread sender([&] { accepted = queue.send(packet(1)); });
  queue.closeReceiver();
  sender.join();
  EXPECT_FALSE(accepted);
}

}  // namespace
}  // namespace lamp
