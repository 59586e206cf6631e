#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "g2o/G2oLines.h"

namespace lamp {

/** What the ids of a file stand for: poses, landmarks, offsets of sensors. */
class G2oNodes {
 public:
  struct Node {
    const G2oLine* vertex = nullptr;
    const G2oLine* fixed = nullptr;  ///< the line that fixes it
  };

  /** \throws std::runtime_error naming the line: for a node with two poses; an id that is a pose
   * and a landmark; FIX of a node that the file does not have, or does not place. */
  explicit G2oNodes(const G2oLines& file);

  const std::map<uint64_t, Node>& poses() const { return poses_; }
  const std::map<uint64_t, Node>& landmarks() const { return landmarks_; }
  /** Of the sensor that a line refers to. \throws std::runtime_error naming the line. */
  Pose3 offset(const G2oLine& line) const;

 private:
  void collect(const G2oLine& line);
  void addVertex(const G2oLine& line, Node& node) const;
  void fix(const G2oLine& line);
  void checkFixed() const;

  const G2oLines& file_;
  std::map<uint64_t, Node> poses_, landmarks_;
  std::map<uint64_t, Pose3> offsets_;
};

/** The letter of a GTSAM symbol, 0 of any other id. */
char letterOf(uint64_t id);
/** A symbol's number, without its letter. */
uint64_t numberOf(uint64_t id);

}  // namespace lamp
