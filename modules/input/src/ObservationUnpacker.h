#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CObservation.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>
#include <mrpt/poses/CPose3D.h>

#include <deque>

namespace lamp {

/** Makes one kind of recording of MRPT's two: single observations in file order.
 *
 * Sensory frames are taken apart. Motion increments of action–sensory frame pairs are summed up to
 * CObservationOdometry (2D) or CObservationRobotPose (3D) with the label `odometry` and the stamp
 * of the frame that follows, whose robot part of the label they take over. The first reading is the
 * identity at the frame before the first action, if there is one.
 */
class ObservationUnpacker {
 public:
  /** \param object CObservation, CSensoryFrame, or CActionCollection. */
  void push(const mrpt::serialization::CSerializable::Ptr& object);
  /** No more objects: gives out what waits for the next one. */
  void finish();

  /** The next observation; null if there is none yet. */
  mrpt::obs::CObservation::Ptr pop();

  /** Observations that were dropped because neither they nor their action had a stamp. */
  size_t withoutStamp() const { return without_stamp_; }

 private:
  using TimeStamp = mrpt::system::TTimeStamp;
  using Frame = std::vector<mrpt::obs::CObservation::Ptr>;

  void pushActions(const mrpt::obs::CActionCollection& actions);
  void pushFrame(Frame frame);
  void emitHeldFrame();
  void emitOdometry(TimeStamp stamp, const std::string& robot_prefix);
  void emit(const mrpt::obs::CObservation::Ptr& observation, TimeStamp fallback);

  std::deque<mrpt::obs::CObservation::Ptr> ready_;
  Frame held_frame_;  ///< the first one, until it is known whether actions follow
  bool frame_seen_ = false;
  bool planar_motion_ = false;
  bool spatial_motion_ = false;
  bool action_pending_ = false;  ///< an increment was added since the last odometry reading
  TimeStamp action_stamp_ = INVALID_TIMESTAMP;
  mrpt::poses::CPose2D planar_pose_;
  mrpt::poses::CPose3D spatial_pose_;
  size_t without_stamp_ = 0;
};

}  // namespace lamp
