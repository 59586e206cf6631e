#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "InputStream.h"
#include "ObservationUnpacker.h"
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
  /** Robot, label, class. */
  using LabelKey = std::tuple<RobotId, std::string, std::string>;

  void readMore();
  void accept(const mrpt::obs::CObservation::Ptr& observation);
  std::pair<RobotId, std::string> robotAndLabel(const std::string& sensor_label);
  std::string unnamedRobot(const std::string& sensor_label) const;
  bool chosen(RobotId robot, const LabelReport& label);
  bool stampGrows(const LabelKey& key, double stamp, LabelReport& label);

  const std::string path_;
  const std::vector<std::string> named_by_;
  const std::string external_folder_;
  RobotRegistry& registry_;
  RawlogReader reader_;
  ObservationUnpacker unpacker_;
  TimeSorter sorter_;
  std::map<LabelKey, double> last_stamp_;
  /** Label and class of the odometry that each robot uses. */
  std::map<RobotId, std::pair<std::string, std::string>> odometry_;
  bool at_end_ = false;
};

}  // namespace lamp
