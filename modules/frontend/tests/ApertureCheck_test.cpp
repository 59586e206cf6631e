#include "ApertureCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lamp {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr int kBeams = 181;

/** What a laser of 180 degrees sees of an L-shaped room from its corner, turned by `yaw`. */
mrpt::obs::CObservation2DRangeScan scanAt(double yaw) {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.maxRange = 30;
  scan.resizeScan(kBeams);
  for (int i = 0; i < kBeams; ++i) {
    const double angle = yaw + (i - 90) * kDegree;
    const double x = std::cos(angle), y = std::sin(angle);
    double range = 29;
    const auto wall = [&](double direction, double place) {
      if (place / direction > 0) range = std::min(range, place / direction);
    };
    wall(x, 4), wall(x, -3), wall(y, 2.5), wall(y, -6);
    if (x > 0.3 && y > 0.1) range = std::min(range, 1.8);  // a cupboard
    scan.setScanRange(static_cast<size_t>(i), static_cast<float>(range));
    scan.setScanRangeValidity(static_cast<size_t>(i), true);
  }
  return scan;
}

/** The contradiction, in degrees, after turning in place; 0 of none. */
double afterTurning(double recorded_deg, double step_deg, int steps) {
  ApertureCheck check;
  for (int i = 0; i < steps; ++i) {
    const double yaw = i * step_deg * kDegree;
    check.observe(scanAt(yaw), recorded_deg * kDegree, planarPose(0, 0, yaw));
  }
  return check.contradiction().value_or(0) / kDegree;
}

TEST(ApertureCheck, FindsAFieldOfViewThatIsRecordedWrongly) {
  for (const double step : {1.3, 5.0, -7.0}) {
    EXPECT_NEAR(afterTurning(90, step, 120), 180, 15) << step;
    EXPECT_NEAR(afterTurning(270, step, 120), 180, 15) << step;
    EXPECT_EQ(afterTurning(180, step, 120), 0) << step;
  }
}

TEST(ApertureCheck, SaysNothingWithoutTurning) {
  EXPECT_EQ(afterTurning(90, 0, 100), 0);
  EXPECT_EQ(afterTurning(90, 5, 4), 0) << "too little";
  ApertureCheck check;
  EXPECT_FALSE(check.contradiction());
  for (int i = 0; i < 100; ++i) check.observe({}, 0, planarPose(0, 0, 0.1 * i));
  EXPECT_FALSE(check.contradiction()) << "scans without beams";
}

}  // namespace
}  // namespace lamp
