#pragma once

#include <deque>
#include <map>
#include <vector>

#include "lamp/loop_candidates/CandidateGenerator.h"
#include "lamp/scans/PlaceDescriptor.h"

namespace lamp {

struct PlaceRecognitionOptions {
  double neighborhood_m = 10.0;
  double radius_m = 60.0;
  double planar_radius_m = 15.0;
  double min_similarity = 0.7;
  double planar_min_similarity = 0.45;
  int max_per_robot = 3;
  int max_other_robots = 4;

  void visit(OptionVisitor& v);
};

/** For robots whose poses cannot be compared (PoseGraph::shareFrame): the key nodes of the other
 * robot whose surroundings look most alike (PlaceDescriptor), whichever way the robots came.
 *
 * The surroundings are the scans of the way before a key node and after it, placed by odometry:
 * what a single scan shows depends too much on where it was taken. So a key node's candidates are
 * proposed when the robot has gone on, or has ended. They must be where those of its robot's
 * previous key node were, too: who drives through a known place recognises it more than once.
 * Proposes nothing once the robots share a frame. */
class PlaceRecognition : public CandidateGenerator {
  DEFINE_MRPT_OBJECT(PlaceRecognition, lamp)

 public:
  PlaceRecognitionOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  void add(const KeyNodePacket& packet) override;
  void end(RobotId robot) override;
  std::vector<LoopClosureCandidate> propose(const PoseGraph& graph, KeyNodeId current) override;

 private:
  /** A key node on its robot's way. */
  struct Station {
    KeyNodeId id;
    double travelled_m = 0;
    Pose3 odom_T_base = Pose3::Identity();
    KeyedScanPtr scan;
    bool planar = false;
  };
  struct Place {
    KeyNodeId id;
    PlaceDescriptor descriptor;
    Eigen::Matrix3d level_R_base;
    double travelled_m;
  };
  struct Robot {
    std::deque<Station> stations;  ///< what the next descriptors need
    size_t described = 0;          ///< of the stations
    std::vector<Place> places;
    size_t asked = 0;  ///< of the places: those that candidates were sought for
    /** Where on the other robots' ways the last of these looked most alike, metres travelled. */
    std::map<RobotId, std::vector<double>> recognized;
    Eigen::MatrixXf magnitudes;  ///< of the descriptors, a column each; grows by doubling
  };
  struct Alike {
    PlaceMatch match;  ///< how the place is turned against the other one
    const Place* other = nullptr;
  };

  void describe(Robot& robot, bool ended) const;
  Place placeAt(const Robot& robot, size_t station) const;
  /** The few places of a robot that look most like one, best first. */
  std::vector<Alike> mostAlike(const Robot& robot, const Place& place) const;
  /** Those that agree with where the robot's previous place was recognised. */
  std::vector<Alike> confirmed(const std::vector<Alike>& alike,
                               const std::vector<double>& previous) const;
  LoopClosureCandidate candidate(const PoseGraph& graph, const Place& place,
                                 const Alike& alike) const;

  std::map<RobotId, Robot> robots_;
};

}  // namespace lamp
