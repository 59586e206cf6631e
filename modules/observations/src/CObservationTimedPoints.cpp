#include "lamp/observations/CObservationTimedPoints.h"

#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <stdexcept>

namespace lamp {

IMPLEMENTS_SERIALIZABLE(CObservationTimedPoints, CObservation, lamp)

namespace {

/** In the order of this file, so after the class's description, before which MRPT_INITIALIZER may
 * run where the compiler does not fold that. */
[[maybe_unused]] const bool registered = [] {
  mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(CObservationTimedPoints, lamp));
  return true;
}();

using mrpt::serialization::CArchive;

void write(CArchive& out, const std::vector<float>& column) {
  out.WriteAs<uint64_t>(column.size());
  if (!column.empty()) out.WriteBufferFixEndianness(column.data(), column.size());
}

/** Grows as it reads: a size that damage has made large must not take memory first. */
void read(CArchive& in, std::vector<float>& column) {
  constexpr uint64_t kAtOnce = 1 << 16;
  column.clear();
  for (auto left = in.ReadAs<uint64_t>(); left > 0;) {
    const auto count = static_cast<size_t>(std::min(left, kAtOnce));
    column.resize(column.size() + count);
    const size_t bytes = in.ReadBufferFixEndianness(column.data() + column.size() - count, count);
    if (bytes < count) throw std::runtime_error("the points of the observation are cut off");
    left -= count;
  }
}

}  // namespace

void CObservationTimedPoints::reserve(size_t points) {
  for (auto* column : {&x, &y, &z, &intensity, &time}) column->reserve(points);
}

uint8_t CObservationTimedPoints::serializeGetVersion() const {
  return 0;
}

void CObservationTimedPoints::serializeTo(CArchive& out) const {
  out << sensorLabel << timestamp << sensorPose;
  for (const auto* column : {&x, &y, &z, &intensity, &time}) write(out, *column);
}

void CObservationTimedPoints::serializeFrom(CArchive& in, uint8_t version) {
  if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
  in >> sensorLabel >> timestamp >> sensorPose;
  for (auto* column : {&x, &y, &z, &intensity, &time}) read(in, *column);
  const bool whole = y.size() == size() && z.size() == size() && time.size() == size() &&
                     (intensity.empty() || intensity.size() == size());
  if (!whole) throw std::runtime_error("the columns of the observation differ in length");
}

void CObservationTimedPoints::getDescriptionAsText(std::ostream& out) const {
  CObservation::getDescriptionAsText(out);
  out << "Sensor pose on the robot: " << sensorPose.asString() << "\nPoints: " << size()
      << (intensity.empty() ? " without" : " with") << " intensity\n";
  if (time.empty()) return;
  const auto [first, last] = std::minmax_element(time.begin(), time.end());
  out << "Times of points: from " << *first << " to " << *last << " s after the stamp\n";
}

void CObservationTimedPoints::getVisualizationInto(mrpt::opengl::CSetOfObjects& scene) const {
  auto cloud = mrpt::opengl::CPointCloudColoured::Create();
  cloud->setPose(sensorPose);
  cloud->setPointSize(2);
  cloud->reserve(size());
  if (!time.empty()) {
    const auto [first, last] = std::minmax_element(time.begin(), time.end());
    const float span = std::max(*last - *first, 1e-6f);
    for (size_t i = 0; i < size(); ++i) {
      const auto color =
          mrpt::img::colormap(mrpt::img::cmJET, static_cast<double>((time[i] - *first) / span));
      cloud->push_back(x[i], y[i], z[i], color.R, color.G, color.B);
    }
  }
  scene.insert(cloud);
}

}  // namespace lamp
