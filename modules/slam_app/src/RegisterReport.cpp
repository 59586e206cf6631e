#include "RegisterReport.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

namespace lamp {

namespace {

constexpr double kDegrees = 180.0 / M_PI;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char text[400];
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

/** One line of the report: the name in a column of its own, then the text. */
std::string line(const std::string& name, const std::string& text) {
  return format("%-20s ", name.c_str()) + text + "\n";
}

std::string cloudLine(const char* role, const RegisteredCloud& cloud) {
  std::string text = cloud.path + ": " + std::to_string(cloud.read) + " points";
  if (cloud.left_out > 0)
    text += ", " + std::to_string(cloud.left_out) +
            " left out: not finite, 0 0 0, too far away or noise";
  if (cloud.leaf_m > 0)
    text += format(", thinned to %zu with voxels of %.2f m", cloud.scan->size(), cloud.leaf_m);
  text = line(role, text);
  if (!cloud.offset.isZero())
    text += line("", "its frame: world coordinates less " + offsetText(cloud));
  for (const std::string& note : cloud.notes) text += line("", note);
  return text;
}

std::string poseText(const Pose3& pose) {
  const Vector6d v = yawPitchRollFromPose(pose);
  return format("x y z %.3f %.3f %.3f m, yaw pitch roll %.2f %.2f %.2f deg", v[0], v[1], v[2],
                v[3] * kDegrees, v[4] * kDegrees, v[5] * kDegrees);
}

std::string alignerLines(const AlignerOutcome& outcome) {
  const AlignmentResult& alignment = outcome.alignment;
  if (alignment.hypotheses.empty()) return line(outcome.aligner, "refuses: " + alignment.refusal);
  std::string text;
  for (const Hypothesis& hypothesis : alignment.hypotheses) {
    std::string what = poseText(hypothesis.target_T_source);
    if (hypothesis.inliers > 0)
      what += format(" (%zu inliers, %.0f %%)", hypothesis.inliers, 100 * hypothesis.inlier_ratio);
    text += line(text.empty() ? outcome.aligner : "", what);
  }
  return text;
}

std::string scoreLines(const std::vector<Score>& scores) {
  std::string text;
  for (const Score& score : scores)
    text += line("  " + score.name,
                 format("%.4g", score.value) +
                     (score.threshold ? format(" (threshold %.4g)", *score.threshold) : ""));
  return text;
}

/** Standard deviations in the tangent space; none for axes that are not wholly observed. */
std::array<std::optional<double>, 6> deviations(const Matrix6d& information) {
  constexpr double kNothing = 1e-10, kUnobservedPart = 1e-2;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(information);
  const double least = kNothing * solver.eigenvalues().maxCoeff();
  Vector6d variance = Vector6d::Zero(), unobserved = Vector6d::Zero();
  for (int k = 0; k < 6; ++k) {
    const Vector6d squares = solver.eigenvectors().col(k).cwiseAbs2();
    if (solver.eigenvalues()[k] > least)
      variance += squares / solver.eigenvalues()[k];
    else
      unobserved += squares;
  }
  std::array<std::optional<double>, 6> sigmas;
  for (int axis = 0; axis < 6; ++axis)
    if (unobserved[axis] < kUnobservedPart) sigmas[axis] = std::sqrt(variance[axis]);
  return sigmas;
}

std::string deviationLines(const Matrix6d& information) {
  const auto sigmas = deviations(information);
  const auto three = [&](size_t first, double factor) {
    std::string text;
    for (size_t axis = first; axis < first + 3; ++axis)
      text += sigmas[axis] ? format(" %.3f", factor * *sigmas[axis]) : " -";
    return text;
  };
  return line("  std. deviation", "along x y z of the source" + three(0, 1) + " m, about them" +
                                      three(3, kDegrees) + " deg; - if not observed");
}

std::string resultLines(const PairRegistration& pair) {
  const RegistrationResult& result = pair.attempt.result;
  std::string text = line("start", poseText(result.start));
  text += line("refined", result.converged
                              ? "converged after " + std::to_string(result.iterations) + " steps"
                              : "did not converge");
  text += scoreLines(pair.attempt.scores);
  text += line("target_T_source", poseText(result.target_T_source));
  text += deviationLines(result.information);
  for (const std::string& direction : result.unobserved) text += line("  not observed", direction);
  return text;
}

}  // namespace

std::string offsetText(const RegisteredCloud& cloud) {
  return format("%.0f %.0f %.0f m", cloud.offset.x(), cloud.offset.y(), cloud.offset.z());
}

std::string registerReport(const PairRegistration& pair) {
  std::string text = cloudLine("source", pair.source) + cloudLine("target", pair.target);
  if (pair.planar) text += line("", "both are level: only x, y and yaw are estimated");
  for (const AlignerOutcome& outcome : pair.attempt.alignments) text += alignerLines(outcome);
  if (pair.hasResult()) text += resultLines(pair);
  text += line("time",
               format("prepare %.3f s and %.3f s, align, refine and verify %.3f s",
                      pair.prepare_source_s, pair.prepare_target_s, pair.align_refine_verify_s));
  return text + line("verdict", pair.verdict());
}

}  // namespace lamp
