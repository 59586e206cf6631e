#pragma once

#include <mrpt/obs/CObservation.h>
#include <mrpt/opengl/Visualizable.h>
#include <mrpt/poses/CPose3D.h>

#include <vector>

namespace lamp {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"  // MRPT's Visualizable has none

/** What a lidar of any kind measured, with the time of each point, for which no class of MRPT 2.5.8
 * has room. The stamp is that which times count from; a driver may choose the begin, the middle or
 * the end of a sweep.
 *
 * MRPT's programs read it with the library of this module as a plugin:
 * `rawlog-edit -p liblamp-observations.so`, `RawLogViewer -l liblamp-observations.so`. */
class CObservationTimedPoints : public mrpt::obs::CObservation, public mrpt::opengl::Visualizable {
  DEFINE_SERIALIZABLE(CObservationTimedPoints, lamp)

 public:
  mrpt::poses::CPose3D sensorPose;  ///< base_T_sensor at the stamp
  std::vector<float> x, y, z;       ///< in the sensor's frame at the time of the point, metres
  std::vector<float> intensity;     ///< empty, or as long as `x`
  std::vector<float> time;          ///< seconds since the stamp, may be negative; as long as `x`

  size_t size() const { return x.size(); }
  void reserve(size_t points);

  void getSensorPose(mrpt::poses::CPose3D& pose) const override { pose = sensorPose; }
  void setSensorPose(const mrpt::poses::CPose3D& pose) override { sensorPose = pose; }
  void getDescriptionAsText(std::ostream& out) const override;
  /** The points, coloured by time. */
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const override;
};

#pragma GCC diagnostic pop

}  // namespace lamp
