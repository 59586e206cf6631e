#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "InputStream.h"
#include "LabelNaming.h"
#include "ObservationUnpacker.h"
#include "RobotClock.h"
#include "RobotRegistry.h"
#include "TimeSorter.h"
#include "lamp/input/RawlogReader.h"

namespace lamp {

/** One rawlog: reads, unpacks, gives each observation its robot, checks stamps, and sorts. */
class RecordingStream : public InputStream {
 public:
  /** \param named_by robots whose options name this rawlog.
   *  \param registry outlives the stream. */
  RecordingStream(const std::string& path, std::vector<std::string> named_by,
                  RobotRegistry& registry);

  std::optional<double> nextStamp() override;
  InputObservation pop() override { return sorter_.pop(); }
  double progress() const override { return reader_.progress(); }
  std::optional<RecordingReport> report() const override;

 private:
  void readMore();
  void accept(const mrpt::obs::CObservation::Ptr& observation);
  bool chosen(RobotId robot, const LabelReport& label);
  RobotClock& clockOf(RobotId robot);

  const std::string path_;
  const std::string external_folder_;
  RobotRegistry& registry_;
  const LabelNaming naming_;
  RawlogReader reader_;
  ObservationUnpacker unpacker_;
  TimeSorter sorter_;
  std::map<RobotId, RobotClock> clocks_;
  /** Label and class of the odometry that each robot uses. */
  std::map<RobotId, std::pair<std::string, std::string>> odometry_;
  bool at_end_ = false;
};

}  // namespace lamp
