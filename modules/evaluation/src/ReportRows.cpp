#include "ReportRows.h"

namespace lamp::evaluation {

const std::vector<ReportRow> kTrajectoryRows = {
    {"ATE RMSE [m]", "{result/ate_rmse_m:3} ({odometry/ate_rmse_m:3})"},
    {"ATE mean [m]", "{result/ate_mean_m:3} ({odometry/ate_mean_m:3})"},
    {"ATE max [m]", "{result/ate_max_m:3} ({odometry/ate_max_m:3})"},
    {"rotation error mean [deg]", "{result/rotation_mean_deg:2} ({odometry/rotation_mean_deg:2})"},
    {"rotation error max [deg]", "{result/rotation_max_deg:2} ({odometry/rotation_max_deg:2})"},
    {"drift per 10 m [%]",
     "{result/drift_10m/translation_percent:2} ({odometry/drift_10m/translation_percent:2})"},
    {"drift per 10 m [deg/m]",
     "{result/drift_10m/rotation_deg_per_m:4} ({odometry/drift_10m/rotation_deg_per_m:4})"},
    {"drift per 100 m [%]",
     "{result/drift_100m/translation_percent:2} ({odometry/drift_100m/translation_percent:2})"},
    {"drift per 100 m [deg/m]",
     "{result/drift_100m/rotation_deg_per_m:4} ({odometry/drift_100m/rotation_deg_per_m:4})"},
    {"scans scored", "{result/scans_joined:0} ({result/scans_joined_share%1} %)"},
    {"truth covered [%]", "{result/truth_covered_share%1}"},
};
const std::vector<ReportRow> kStageRows = {
    {"pairs", "{accepted:0}"},
    {"right / wrong / neither", "{right:0} / {wrong:0} / {neither:0}"},
    {"true / false / between", "{true_pairs:0} / {false_pairs:0} / {between_pairs:0}"},
    {"precision [%]", "{precision%2}"},
    {"recall [%]", "{recall%2}"},
    {"accepted / true [%]", "{recall_of_pairs%2}"},
    {"F/P [%]", "{false_positives%2}"},
};
const std::vector<ReportRow> kLoopErrorRows = {
    {"mean / median / max [m]",
     "{kept_translation_error/mean_m:3} / {kept_translation_error/median_m:3} / "
     "{kept_translation_error/max_m:3}"},
    {"mean / median / max [deg]",
     "{kept_rotation_error/mean_deg:2} / {kept_rotation_error/median_deg:2} / "
     "{kept_rotation_error/max_deg:2}"},
};
const std::vector<ReportRow> kCovarianceRows = {
    {"beyond their 95 % [%]", "{beyond_95_share%1}"},
    {"normalised variance x / y / z",
     "{normalized_variance/x:2} / {normalized_variance/y:2} / {normalized_variance/z:2}"},
    {"normalised variance roll / pitch / yaw",
     "{normalized_variance/roll:2} / {normalized_variance/pitch:2} / "
     "{normalized_variance/yaw:2}"},
};
const std::vector<ReportRow> kMapRows = {
    {"accuracy mean [m]", "{accuracy_mean_m:3}"},
    {"accuracy 95 % [m]", "{accuracy_p95_m:3}"},
    {"completeness [%]", "{completeness_share%1}"},
    {"points of movers that stay [%]", "{moving/kept_share%2}"},
    {"points of the surface that go [%]", "{surface/removed_share%3}"},
    {"stray points that stay [%]", "{stray/kept_share%1}"},
};
const std::vector<ReportRow> kOctoMapRows = {
    {"surface marked free [%]", "{surface/marked_free_share%2}"},
    {"free space marked occupied [%]", "{free_space/marked_occupied_share%3}"},
    {"driven floor known [%]", "{driven_floor/known_share%1}"},
    {"way of movers marked occupied [%]", "{moving/marked_occupied_share%2}"},
};
const std::vector<ReportRow> kRelationRows = {
    {"relations", "{relations:0}"},
    {"translation [m]", "{translation_mean_m:4} ± {translation_std_m:4}"},
    {"rotation [deg]", "{rotation_mean_deg:3} ± {rotation_std_deg:3}"},
};

}  // namespace lamp::evaluation
