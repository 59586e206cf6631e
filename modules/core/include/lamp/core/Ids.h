#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace lamp {

/** A robot, by its place in the RobotTable. */
struct RobotId {
  uint16_t value = 0;

  friend bool operator==(RobotId a, RobotId b) { return a.value == b.value; }
  friend bool operator!=(RobotId a, RobotId b) { return a.value != b.value; }
  friend bool operator<(RobotId a, RobotId b) { return a.value < b.value; }
};

/** A key node: the robot and the key node's sequential index on that robot, from 0. */
struct KeyNodeId {
  RobotId robot;
  uint32_t index = 0;

  friend bool operator==(KeyNodeId a, KeyNodeId b) {
    return a.robot == b.robot && a.index == b.index;
  }
  friend bool operator!=(KeyNodeId a, KeyNodeId b) { return !(a == b); }
  friend bool operator<(KeyNodeId a, KeyNodeId b) {
    return std::tie(a.robot, a.index) < std::tie(b.robot, b.index);
  }
};

/** Names and letters of the robots, in the order of the ini, the command line, then the recording.
 *
 * Letters make GTSAM's 64-bit `Symbol` (in the top byte, index below), as in NeBula's data: a-z but
 * `u`, which stands for UWB anchors there, A-Z, 0-9, then the bytes from 0x80 on; 189 robots.
 */
class RobotTable {
 public:
  /** \param letter a letter or digit, or 0 for the next free one.
   *  \throws std::runtime_error if the name or letter is taken, or the name has characters outside
   *  `[A-Za-z0-9_-]`. */
  RobotId add(const std::string& name, char letter = 0);

  std::optional<RobotId> find(const std::string& name) const;
  size_t size() const { return robots_.size(); }
  std::vector<RobotId> ids() const;
  const std::string& name(RobotId robot) const { return robots_.at(robot.value).name; }
  char letter(RobotId robot) const { return robots_.at(robot.value).letter; }

  /** `name:index`, the form used in all text files. */
  std::string format(KeyNodeId id) const;
  /** Inverse of format(). \throws std::runtime_error naming the text. */
  KeyNodeId parse(const std::string& text) const;

  uint64_t symbol(KeyNodeId id) const;
  /** Inverse of symbol(). \throws std::runtime_error if no robot has the letter, or the index has
   *  more than 32 bits. */
  KeyNodeId fromSymbol(uint64_t symbol) const;

 private:
  struct Robot {
    std::string name;
    char letter;
  };
  bool letterTaken(char letter) const;
  char nextLetter() const;

  std::vector<Robot> robots_;
};

/** A robot name made of a file's stem: characters outside `[A-Za-z0-9_-]` become `_`. */
std::string robotNameFromStem(const std::string& stem);

}  // namespace lamp

template <>
struct std::hash<lamp::RobotId> {
  size_t operator()(lamp::RobotId id) const noexcept { return id.value; }
};
template <>
struct std::hash<lamp::KeyNodeId> {
  size_t operator()(lamp::KeyNodeId id) const noexcept {
    return (static_cast<size_t>(id.robot.value) << 32) | id.index;
  }
};
