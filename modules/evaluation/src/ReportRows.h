#pragma once

#include <vector>

namespace lamp::evaluation {

/** One row of the table. The pattern shows figures of a run's JSON: `{path:decimals}`, or
 * `{path%decimals}` for a share in percent. */
struct ReportRow {
  const char* label;
  const char* pattern;
};

extern const std::vector<ReportRow> kTrajectoryRows, kStageRows, kLoopErrorRows, kCovarianceRows,
    kMapRows, kOctoMapRows, kRelationRows;

}  // namespace lamp::evaluation
