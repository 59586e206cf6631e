#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "Survey.h"
#include "lamp/frontend/SurveyLocalizer.h"
#include "lamp/scans/PreparedScan.h"
#include "lamp/slam_app/SlamConfig.h"
#include "lamp/transport/Transport.h"

namespace lamp {

/** A scan whose place in the survey is known. */
struct LocalizedScan {
  StampedPose world_T_base;
  double matched_share = 0;  ///< of its points, on surfaces of the survey
  double deviation_m = 0;    ///< of those from the surfaces, robust standard deviation
};

/** What became of one robot. */
struct LocalizedRobot {
  std::vector<double> stamps;        ///< of all scans, seconds, UTC
  std::vector<LocalizedScan> scans;  ///< those that are localised
  /** Why it was not found in the survey; empty if it was, or its start pose was given. */
  std::string not_found;
};

/** Localises the scans of a team in a survey. Gets them from the robots' front ends, to which each
 * scan is a key node. Robots whose start nobody knows are sought in the survey by their scans.
 *
 * Scans fit in wrong places, too: one wall of a corridor is like another. So where a robot starts,
 * and after it was lost, its scans only count once it has come to a place where the survey shows
 * what the scan shows, and holds it in all directions. */
class TeamLocalizer : public MessageSender {
 public:
  /** \param config with its poses in the survey's frame; it and the survey outlive this.
   * \param confirming_share so much of a scan must lie on the survey where a place is confirmed. */
  TeamLocalizer(const SlamConfig& config, Survey& survey, double confirming_share)
      : config_(config), survey_(survey), confirming_share_(confirming_share) {}

  /** \throws std::runtime_error if the robot's lidars do not see in space. */
  bool send(Message message) override;
  const std::map<RobotId, LocalizedRobot>& robots() const { return results_; }
  size_t localizedScans() const { return localized_; }

 private:
  struct Robot {
    std::optional<SurveyLocalizer> localizer;    ///< none as long as nobody knows where it is
    bool confirmed = false;                      ///< that it is there
    std::vector<LocalizedScan> unconfirmed;      ///< since it started, or was lost
    size_t lost_in_a_row = 0;                    ///< scans
    std::optional<Pose3> sought_at, checked_at;  ///< `odom_T_base`, the last time
    int searches = 0;
  };

  void localize(const KeyNodePacket& packet);
  void locate(const KeyNodePacket& packet, Robot& robot);
  void check(const KeyNodePacket& packet, Robot& robot);
  std::optional<StartPrior> sought(const KeyNodePacket& packet, Robot& robot);
  PreparedScan prepared(const KeyedScanPtr& scan) const;

  const SlamConfig& config_;
  Survey& survey_;
  const double confirming_share_;
  std::map<RobotId, Robot> robots_;
  std::map<RobotId, LocalizedRobot> results_;
  size_t localized_ = 0;
};

}  // namespace lamp
