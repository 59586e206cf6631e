#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/input/InputReport.h"
#include "lamp/input/ObservationSource.h"
#include "lamp/input/RobotOptions.h"

namespace lamp {

class InputStream;
class RobotRegistry;

/** Observations of one or several rawlogs, merged in time order.
 *
 * The robot of an observation is the one whose options name the rawlog; else its label's part
 * before the first slash, if that is a robot's; else the file's stem. Observations of one file may
 * be out of order by up to a second and are sorted. Within one label and class, stamps must grow:
 * what does not fit is dropped and counted, and a clock that was set back is moved on.
 */
class RawlogSource : public ObservationSource {
 public:
  /** Opens the rawlogs and reads their beginnings.
   *  \param rawlogs beside those that the robots' options name; one that is named twice counts
   * once. \param robots are added to the table first, in this order; others as they appear. \throws
   * std::runtime_error if a file is missing, empty or no rawlog, or robots clash. */
  RawlogSource(const std::vector<std::string>& rawlogs, const std::vector<RobotOptions>& robots,
               RobotTable& table);
  ~RawlogSource() override;

  /** \throws std::runtime_error if two files give observations of the same robot, or an observation
   *  without a robot in its label comes from a file that several robots' options name. */
  std::optional<InputObservation> next() override;
  double progress() const override;

  /** One for each rawlog, in the order of opening. */
  std::vector<RecordingReport> recordings() const;
  /** One for each robot, in the order of the table. */
  const std::vector<RobotReport>& robots() const;

  /** What a user should know of the input: losses, and options that found nothing. Complete once
   * next() has given none. */
  std::vector<std::string> warnings() const;

 private:
  std::unique_ptr<RobotRegistry> registry_;
  std::vector<std::unique_ptr<InputStream>> streams_;
};

}  // namespace lamp
