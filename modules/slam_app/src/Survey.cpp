#include "Survey.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "lamp/core/CloudFile.h"
#include "lamp/core/Csv.h"
#include "lamp/scans/Cloud.h"

namespace lamp {

namespace {

/** The points of a survey may lie closer, but no registration gains by it. */
constexpr double kLeafM = 0.1;
/** Coarser rounding would be seen in the trajectory. */
constexpr double kMaxRoundingM = 0.02;
/** A survey has so many points at least, thinned, that fill so much space, metres. */
constexpr size_t kFewestPoints = 1000;
constexpr double kLeastSizeM = 3, kMostSizeM = 1e5;

Eigen::AlignedBox3d boxAround(const std::vector<Eigen::Vector3f>& points) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& point : points) box.extend(point);
  return box.cast<double>();
}

void check(const Survey& survey, const CloudPoints& cloud) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error("'" + survey.path + "' " + what);
  };
  if (cloud.rounded_to_m > kMaxRoundingM)
    fail("has coordinates that were rounded to " + formatFixed(cloud.rounded_to_m, 3) +
         " m by being floats: export it with 64-bit coordinates (double), or relative to a point "
         "near it");
  const double size = boxAround(survey.points).sizes().maxCoeff();
  if (size < kLeastSizeM || size > kMostSizeM)
    fail("is " + formatFixed(size, size < 1 ? 3 : 0) + " m large: coordinates must be in metres");
  if (survey.map->size() < kFewestPoints)
    fail("has " + std::to_string(survey.map->size()) + " points that lie " +
         formatFixed(kLeafM, 1) + " m apart: a survey needs " + std::to_string(kFewestPoints) +
         " at least");
}

}  // namespace

Survey readSurvey(const std::string& path) {
  CloudPoints cloud = readCloudPoints(path);
  Survey survey;
  survey.path = path;
  survey.world_p_origin = cloud.offset;
  survey.points = std::move(cloud.points);
  survey.points.erase(std::remove_if(survey.points.begin(), survey.points.end(),
                                     [](const Eigen::Vector3f& point) { return !isUsable(point); }),
                      survey.points.end());
  survey.map = std::make_unique<LocalMap>(kLeafM, false);
  survey.map->add(survey.points, Pose3::Identity(), Eigen::Vector3f::Zero(), 0);
  check(survey, cloud);
  return survey;
}

double distanceFrom(const Survey& survey, const Eigen::Vector3d& survey_p) {
  return boxAround(survey.points).exteriorDistance(survey_p);
}

}  // namespace lamp
