#pragma once

#include "lamp/pose_graph/OutlierRejection.h"

namespace lamp {

struct RobotFramesOptions {
  int min_agreeing = 5;

  void visit(OptionVisitor& v);
};

/** Keeps robots apart while only a few loop closures relate them: without start poses, no odometry
 * between them could contradict a false one. The loops between two robots (chains of odometry) are
 * averaged robustly (frameAverages()); the robots are joined once enough loops agree, each with key
 * nodes of its own. Until then all loops between them stay out. Pieces of one robot's drive,
 * between gaps in its odometry, need no such agreement. */
class RobotFrames : public OutlierRejection {
  DEFINE_MRPT_OBJECT(RobotFrames, lamp)

 public:
  explicit RobotFrames(const RobotFramesOptions& options = {}) : options_(options) {}

  void visit(OptionVisitor& options) override { options_.visit(options); }
  Admission reject(const PoseGraph& graph, Admission before) override;

 private:
  RobotFramesOptions options_;
};

}  // namespace lamp
