#include "lamp/evaluation/TrueSurface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lamp/core/LocalFrame.h"
#include "lamp/core/PlyVertices.h"

namespace lamp::evaluation {

SurfaceSamples SurfaceSamples::fromPly(const std::string& path) {
  const PlyVertices file(path);
  std::vector<std::string> properties = {"x", "y", "z", "nx", "ny", "nz"};
  const bool has_seen = file.has("seen");
  if (has_seen) properties.push_back("seen");
  SurfaceSamples samples;
  samples.points.reserve(file.count());
  samples.normals.reserve(file.count());
  samples.seen.reserve(file.count());
  Eigen::Vector3d file_p_origin = Eigen::Vector3d::Zero();
  file.read(properties, [&](const double* v) {
    const Eigen::Vector3d point(v[0], v[1], v[2]);
    if (samples.points.empty()) file_p_origin = wholeKilometres(point);
    const Eigen::Vector3d normal(v[3], v[4], v[5]);
    if (!(normal.norm() > 0.5)) throw std::runtime_error("'" + path + "' has a zero normal");
    samples.points.push_back((point - file_p_origin).cast<float>());
    samples.normals.push_back(normal.normalized().cast<float>());
    samples.seen.push_back(!has_seen || v[6] != 0);
  });
  samples.world_p_origin = file.offset() + file_p_origin;
  if (std::count(samples.seen.begin(), samples.seen.end(), 1) == 0)
    throw std::runtime_error("'" + path + "' has no sample that was seen");
  return samples;
}

float TrueSurface::distance(const Eigen::Vector3f& point) const {
  constexpr float kReach = 0.2f;
  float squared = 0;
  const size_t nearest = tree_.nearest(point, std::numeric_limits<float>::max(), squared);
  const float along_normal =
      std::abs(samples_.normals[nearest].dot(point - samples_.points[nearest]));
  return squared - along_normal * along_normal > kReach * kReach ? std::sqrt(squared)
                                                                 : along_normal;
}

}  // namespace lamp::evaluation
