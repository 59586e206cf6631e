#include "RegisterReport.h"

namespace lamp {

namespace {

using Json = nlohmann::ordered_json;

template <class Matrix>
Json byRows(const Matrix& matrix) {
  Json numbers = Json::array();
  for (int row = 0; row < matrix.rows(); ++row)
    for (int column = 0; column < matrix.cols(); ++column) numbers.push_back(matrix(row, column));
  return numbers;
}

Json cloudJson(const RegisteredCloud& cloud) {
  return {{"file", cloud.path},
          {"points", cloud.read},
          {"left_out", cloud.left_out},
          {"used", cloud.scan->size()},
          {"leaf_m", cloud.leaf_m > 0 ? Json(cloud.leaf_m) : Json()},
          {"offset", {cloud.offset.x(), cloud.offset.y(), cloud.offset.z()}},
          {"notes", cloud.notes}};
}

Json scoresJson(const std::vector<Score>& scores) {
  Json json = Json::object();
  for (const Score& score : scores)
    json[score.name] = {{"value", score.value},
                        {"threshold", score.threshold ? Json(*score.threshold) : Json()}};
  return json;
}

Json hypothesesJson(const std::vector<AlignerOutcome>& alignments) {
  Json json = Json::array();
  for (const AlignerOutcome& outcome : alignments)
    for (const Hypothesis& hypothesis : outcome.alignment.hypotheses)
      json.push_back({{"aligner", outcome.aligner},
                      {"target_T_source", byRows(hypothesis.target_T_source.matrix())},
                      {"inliers", hypothesis.inliers},
                      {"inlier_ratio", hypothesis.inlier_ratio}});
  return json;
}

}  // namespace

Json registerJson(const PairRegistration& pair) {
  const LoopClosureAttempt& attempt = pair.attempt;
  const RegistrationResult& result = attempt.result;
  const bool found = pair.hasResult();
  return {{"program", "lamp-register"},
          {"source", cloudJson(pair.source)},
          {"target", cloudJson(pair.target)},
          {"planar", pair.planar},
          {"accepted", attempt.accepted},
          {"stage", attempt.stage},
          {"reason", attempt.reason},
          {"target_T_source", found ? byRows(result.target_T_source.matrix()) : Json()},
          {"information", found ? byRows(result.information) : Json()},
          {"unobserved", result.unobserved},
          {"scores", scoresJson(attempt.scores)},
          {"hypotheses", hypothesesJson(attempt.alignments)},
          {"timings_s",
           {{"prepare_source", pair.prepare_source_s},
            {"prepare_target", pair.prepare_target_s},
            {"align_refine_verify", pair.align_refine_verify_s}}}};
}

}  // namespace lamp
