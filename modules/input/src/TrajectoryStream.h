#pragma once

#include <string>
#include <vector>

#include "InputStream.h"
#include "RobotRegistry.h"
#include "lamp/core/KeyNodePacket.h"

namespace lamp {

/** A robot's odometry from a TUM file, as CObservationRobotPose with the label `odometry_file`. */
class TrajectoryStream : public InputStream {
 public:
  /** \param registry outlives the stream. \throws what readTum() does. */
  TrajectoryStream(RobotId robot, const std::string& tum_file, RobotRegistry& registry);

  std::optional<double> nextStamp() override;
  InputObservation pop() override;
  double progress() const override;
  std::optional<RecordingReport> report() const override { return {}; }

 private:
  const RobotId robot_;
  RobotRegistry& registry_;
  const std::vector<StampedPose> poses_;
  size_t next_ = 0;
};

}  // namespace lamp
