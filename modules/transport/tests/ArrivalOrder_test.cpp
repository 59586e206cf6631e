#include "lamp/transport/ArrivalOrder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "lamp/transport/InProcessQueue.h"

namespace lamp {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr RobotId kA{0}, kB{1}, kC{2};

Message node(RobotId robot, uint32_t index, double stamp) {
  KeyNodePacket packet;
  packet.id = {robot, index};
  packet.stamp = stamp;
  return packet;
}

Message end(RobotId robot) {
  return RobotEnd{robot, {}};
}

/** `A0`, `B12`, `A.` for its end. */
std::string nameOf(const Message& message) {
  const auto letter = [](RobotId robot) {
    return std::string(1, static_cast<char>('A' + robot.value));
  };
  if (const auto* packet = std::get_if<KeyNodePacket>(&message))
    return letter(packet->id.robot) + std::to_string(packet->id.index);
  return letter(std::get<RobotEnd>(message).robot) + ".";
}

/** Gives messages, and remembers how many were asked for. */
class Recorded : public MessageReceiver {
 public:
  explicit Recorded(std::vector<Message> messages) : messages_(std::move(messages)) {}
  std::optional<Message> receive() override {
    if (given == messages_.size()) return std::nullopt;
    return messages_[given++];
  }
  size_t given = 0;

 private:
  const std::vector<Message> messages_;
};

std::vector<std::string> receiveAll(MessageReceiver& receiver) {
  std::vector<std::string> names;
  while (const auto message = receiver.receive()) names.push_back(nameOf(*message));
  return names;
}

/** Everything up to a stamp arrives together. */
ArrivalTimes allAt(double arrival) {
  return ArrivalTimes({{arrival, arrival}});
}

TEST(ArrivalOrder, ARobotOutOfLinkComesLate) {
  Recorded recorded({node(kA, 0, 1), node(kB, 0, 1), node(kB, 1, 2), node(kA, 1, 3), node(kA, 2, 4),
                     node(kB, 2, 5), end(kA), end(kB)});
  ArrivalOrder order(recorded, {{kA, ArrivalTimes({{1, 3.5}, {3, 9}, {4, 10}})}, {kB, {}}});
  EXPECT_THAT(receiveAll(order), ElementsAre("B0", "B1", "A0", "B2", "B.", "A1", "A2", "A."));
  EXPECT_FALSE(order.receive()) << "and nothing follows";
}

TEST(ArrivalOrder, EqualArrivalsComeInTheRobotsOrder) {
  Recorded recorded(
      {node(kC, 0, 1), node(kB, 0, 2), node(kB, 1, 3), node(kA, 0, 4), end(kC), end(kB), end(kA)});
  ArrivalOrder order(recorded, {{kA, allAt(9)}, {kB, allAt(9)}, {kC, allAt(9)}});
  EXPECT_THAT(receiveAll(order), ElementsAre("A0", "A.", "B0", "B1", "B.", "C0", "C."));
}

TEST(ArrivalOrder, AMessageWaitsUntilNoEarlierOneCanCome) {
  Recorded recorded({node(kA, 0, 1), node(kA, 1, 2), node(kB, 0, 3), end(kB), end(kA)});
  ArrivalOrder order(recorded, {{kA, ArrivalTimes({{1, 4}, {2, 5}})}, {kB, {}}});
  EXPECT_EQ(nameOf(*order.receive()), "B0") << "recorded after A1, but it arrives first";
  EXPECT_EQ(recorded.given, 3u) << "no more is read than is needed";
  EXPECT_EQ(order.held(), 2u);
  EXPECT_THAT(receiveAll(order), ElementsAre("B.", "A0", "A1", "A."));
  EXPECT_EQ(order.held(), 0u);
}

TEST(ArrivalOrder, RobotsThatNeverSendAnythingDoNotBlock) {
  Recorded recorded({node(kB, 0, 1), node(kB, 1, 2), end(kB)});
  ArrivalOrder order(recorded, {{kA, allAt(100)}, {kB, {}}, {kC, allAt(0)}});
  EXPECT_THAT(receiveAll(order), ElementsAre("B0", "B1", "B."));

  Recorded nothing({});
  ArrivalOrder empty(nothing, {{kA, {}}});
  EXPECT_THAT(receiveAll(empty), IsEmpty());
}

TEST(ArrivalOrder, AStreamThatBreaksOffGivesWhatCame) {
  Recorded recorded({node(kA, 0, 1), node(kB, 0, 2), node(kA, 1, 3)});
  ArrivalOrder order(recorded, {{kA, allAt(100)}, {kB, {}}});
  EXPECT_THAT(receiveAll(order), ElementsAre("B0", "A0", "A1"));
}

TEST(ArrivalOrder, AnEndWithoutKeyNodesAndAnUnknownRobotPass) {
  Recorded recorded({node(kA, 0, 1), node(kC, 0, 3), end(kA), end(kB), end(kC)});
  ArrivalOrder order(recorded, {{kA, allAt(5)}, {kB, {}}});
  EXPECT_THAT(receiveAll(order), ElementsAre("B.", "C0", "C.", "A0", "A."));
}

TEST(ArrivalOrder, StampsThatGoBackKeepTheRobotsOrder) {
  Recorded recorded({node(kA, 0, 5), node(kA, 1, 2), node(kB, 0, 3), end(kA), end(kB)});
  ArrivalOrder order(recorded, {{kA, {}}, {kB, {}}});
  EXPECT_THAT(receiveAll(order), ElementsAre("B0", "B.", "A0", "A1", "A."));
}

/** The order by sorting, which needs all messages at once. */
std::vector<std::string> sorted(const std::vector<Message>& messages,
                                const std::map<RobotId, ArrivalTimes>& arrivals) {
  struct Entry {
    double arrival;
    RobotId robot;
    std::string name;
  };
  std::vector<Entry> entries;
  std::map<RobotId, double> last;
  for (const Message& message : messages) {
    if (const auto* packet = std::get_if<KeyNodePacket>(&message)) {
      last[packet->id.robot] = arrivals.at(packet->id.robot).at(packet->stamp);
      entries.push_back({last[packet->id.robot], packet->id.robot, nameOf(message)});
    } else {
      const RobotId robot = std::get<RobotEnd>(message).robot;
      entries.push_back({last[robot], robot, nameOf(message)});
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.arrival, a.robot) < std::tie(b.arrival, b.robot);
  });
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.push_back(entry.name);
  return names;
}

TEST(ArrivalOrder, EqualsSortingThroughASmallQueue) {
  std::mt19937 random(1);
  std::uniform_int_distribution<int> dice(0, 19);
  for (int trial = 0; trial < 20; ++trial) {
    std::map<RobotId, ArrivalTimes> arrivals;
    for (const RobotId robot : {kA, kB, kC}) {
      std::vector<ArrivalTimes::Row> rows;
      double arrival = 0;
      for (int stamp = 0; stamp < 200; stamp += 1 + dice(random)) {
        arrival = std::max<double>(arrival, stamp + (dice(random) == 0 ? 80 : 0));
        rows.push_back({static_cast<double>(stamp), arrival});
      }
      arrivals[robot] = ArrivalTimes(rows);
    }
    std::vector<Message> messages;
    std::map<RobotId, uint32_t> count;
    for (int stamp = 0; stamp < 220; ++stamp)
      for (const RobotId robot : {kA, kB, kC})
        if (dice(random) < 7) messages.push_back(node(robot, count[robot]++, stamp));
    for (const RobotId robot : {kA, kB, kC}) messages.push_back(end(robot));

    InProcessQueue queue(2);  // far fewer than are held: the sender must not block for good
    std::thread sender([&] {
      for (const Message& message : messages) queue.send(message);
      queue.closeSender();
    });
    ArrivalOrder order(queue, arrivals);
    EXPECT_EQ(receiveAll(order), sorted(messages, arrivals)) << trial;
    sender.join();
  }
}

}  // namespace
}  // namespace lamp
