// Table II of the paper on a simulated world: what becomes of true and of false pairs of key nodes
// when the refinement starts from the truth, from odometry's rotation, or from a global alignment.
//
//   StartComparison WORLD [--pairs 200] [--seed 1] [--starts Teaser,SacIa] [--set key=value]
#include <CLI/CLI.hpp>
#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <map>
#include <optional>
#include <random>
#include <sstream>

#include "FrontEndTeam.h"
#include "lamp/base_station/BaseStation.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Program.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/pose_graph/MarginalCovariances.h"
#include "lamp/registration/ObservedPart.h"

namespace lamp {
namespace {

struct TruePair {
  LoopClosureCandidate candidate;
  Pose3 from_T_to = Pose3::Identity();
  double overlap = 0;
  bool same_place = false;
};

/** Gives the base station what the front ends send, at once. */
class Handover : public MessageSender {
 public:
  explicit Handover(BaseStation& base) : base_(base) {}
  bool send(Message message) override {
    std::visit([&](const auto& content) { base_.receive(content); }, message);
    return true;
  }

 private:
  BaseStation& base_;
};

/** Starts from the true relative pose. */
class GroundTruth : public InitialAligner {
 public:
  Pose3 truth = Pose3::Identity();
  void visit(OptionVisitor&) override {}
  AlignmentResult align(const PreparedScan&, const PreparedScan&, const Guess&) const override {
    Hypothesis hypothesis;
    hypothesis.target_T_source = truth;
    return {{hypothesis}, ""};
  }
  mrpt::rtti::CObject* clone() const override { return new GroundTruth(*this); }
  const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override {
    return CLASS_ID(InitialAligner);
  }
};

std::vector<TruePair> readPairs(const std::string& path, RobotTable& robots, bool same_place) {
  const CsvTable table = CsvTable::fromFile(path);
  std::vector<TruePair> pairs;
  for (size_t row = 0; row < table.rows.size(); ++row) {
    const auto cell = [&](const char* name) { return table.rows[row][table.column(name)]; };
    if ((cell("pair") == "true") != same_place) continue;
    const auto value = [&](const char* name) { return std::stod(cell(name)); };
    TruePair pair;
    pair.candidate.from = robots.parse(cell("from"));
    pair.candidate.to = robots.parse(cell("to"));
    pair.overlap = value("overlap");
    pair.same_place = same_place;
    pair.from_T_to.linear() =
        Eigen::Quaterniond(value("qw"), value("qx"), value("qy"), value("qz")).toRotationMatrix();
    pair.from_T_to.translation() = Eigen::Vector3d(value("x"), value("y"), value("z"));
    // The older one is the target.
    if (value("from_stamp") > value("to_stamp")) {
      std::swap(pair.candidate.from, pair.candidate.to);
      pair.from_T_to = pair.from_T_to.inverse();
    }
    pairs.push_back(pair);
  }
  return pairs;
}

/** What became of the pairs from one start. */
struct Tally {
  int true_pairs = 0, false_pairs = 0, right = 0, accepted = 0, false_accepted = 0, wrong = 0;
  double translation = 0, rotation = 0;
  double seconds_accepted = 0, seconds_refused = 0;
  int refused = 0;
  std::vector<double> d2;                  ///< of right ones with full information
  Vector6d normalized = Vector6d::Zero();  ///< squared errors by claimed variances
  std::map<std::string, int> reasons;
};

struct Error {
  double m = 0, deg = 0;
};

/** Error of a pose in the directions that its information knows. */
Error errorOf(const Pose3& pose, const Matrix6d& information, const Pose3& truth) {
  const Vector6d d = observedPart(logSE3(pose.inverse() * truth), information);
  return {d.head<3>().norm(), d.tail<3>().norm() * 180 / M_PI};
}

/** Adds how well the claimed covariance covers the error; full ranks only. */
void addCalibration(const RegistrationResult& result, const Pose3& truth, Tally& tally) {
  const Vector6d d = logSE3(result.target_T_source.inverse() * truth);
  if (!result.unobserved.empty()) return;
  const Matrix6d covariance = result.information.inverse();
  tally.d2.push_back(d.dot(result.information * d));
  tally.normalized += d.cwiseAbs2().cwiseQuotient(covariance.diagonal());
}

void printCalibration(const Tally& t) {
  if (t.d2.empty()) return;
  const auto count = static_cast<double>(t.d2.size());
  const double limit = chiSquareQuantile(0.95, 6);
  const auto over = std::count_if(t.d2.begin(), t.d2.end(), [&](double d2) { return d2 > limit; });
  std::printf("    covariance: %.1f %% of d2 over chi2(0.95), normalised variances",
              100.0 * static_cast<double>(over) / count);
  for (int k = 0; k < 6; ++k) std::printf(" %.2f", t.normalized[k] / count);
  std::printf(" (%zu with full information)\n", t.d2.size());
}

void printRow(const std::string& start, const Tally& t) {
  const auto percent = [](int part, int whole) { return 100.0 * part / std::max(whole, 1); };
  std::printf(
      "%-18s recall %5.1f %%  accepted/true %5.1f %%  F/P %4.1f %%  wrong %3d  error %.3f m %.2f "
      "deg  ms accepted %.1f refused %.1f ",
      start.c_str(), percent(t.right, t.true_pairs), percent(t.accepted, t.true_pairs),
      percent(t.false_accepted, t.false_pairs), t.wrong, t.translation / std::max(t.accepted, 1),
      t.rotation / std::max(t.accepted, 1),
      1e3 * t.seconds_accepted / std::max(t.accepted + t.false_accepted, 1),
      1e3 * t.seconds_refused / std::max(t.refused, 1));
  for (const auto& [reason, count] : t.reasons) std::printf(" | %s %d", reason.c_str(), count);
  std::printf("\n");
  std::fflush(stdout);
}

/** The pipeline of the ini from one start: `GroundTruth`, or an initial aligner by name. */
LoopClosureComputation computationFrom(const std::string& start,
                                       const std::shared_ptr<GroundTruth>& truth,
                                       const SlamConfig& config) {
  Faults faults;
  std::shared_ptr<InitialAligner> aligner = truth;
  if (start != "GroundTruth")
    aligner = makeStage<InitialAligner>(StageName::parse(start), "initial aligner", "",
                                        config.ini(), faults);
  faults.throwIfAny();
  const auto verifiers = config.make<Verifier>();
  return {{aligner},
          config.makeOne<Refiner>(),
          {verifiers.begin(), verifiers.end()},
          config.registration.ambiguity};
}

/** So many of the pairs, drawn at random. */
std::vector<TruePair> drawn(std::vector<TruePair> pairs, size_t count, unsigned seed) {
  std::mt19937 random(seed);
  for (size_t i = pairs.size(); i > 1; --i) std::swap(pairs[i - 1], pairs[random() % i]);
  pairs.resize(std::min(pairs.size(), count));
  return pairs;
}

/** A recorded team: its key nodes where odometry alone puts them. */
class Team {
 public:
  Team(const std::string& world, const std::vector<std::string>& overrides)
      : config_(SlamConfig::fromFile(world + "/lamp.ini", overrides, {})),
        base_(config_.makeBaseStationSetup(), timer_),
        scans_(config_.registration.preparation) {
    Handover handover(base_);
    FrontEndTeam front_ends(config_, handover);
    RawlogSource source(config_.input.rawlogs, config_.robots, robots_);
    while (const auto observation = source.next()) front_ends.observe(*observation);
    front_ends.finish();
    for (const auto& [id, packet] : base_.tracks().packets()) scans_.add(packet);
    uncertainty_.emplace(base_.graph());
  }

  const SlamConfig& config() const { return config_; }
  RobotTable& robots() { return robots_; }
  PreparedScanPtr prepared(const PreparedScanStore::Key& key) {
    const PreparedScanPtr scan = scans_.get(key);
    scan->features();  // here, where it is not timed
    return scan;
  }
  PreparedScanPtr source(const TruePair& pair) { return prepared(scans_.source(pair.candidate)); }
  PreparedScanPtr target(const TruePair& pair) { return prepared(scans_.target(pair.candidate)); }
  Guess guess(const TruePair& pair) const {
    const auto& [from, to] = std::pair(pair.candidate.from, pair.candidate.to);
    return {base_.graph().node(from).world_T_base.inverse() * base_.graph().node(to).world_T_base,
            uncertainty_->relativeCovariances(from, {to})[0]};
  }

 private:
  const SlamConfig config_;
  mrpt::system::CTimeLogger timer_{false, ""};
  BaseStation base_;
  RobotTable robots_;
  PreparedScanStore scans_;
  std::optional<MarginalCovariances> uncertainty_;
};

/** Adds one attempt to the tally. */
void count(const TruePair& pair, const LoopClosureAttempt& attempt, double seconds, Tally& tally) {
  (pair.same_place ? tally.true_pairs : tally.false_pairs)++;
  (attempt.accepted ? tally.seconds_accepted : tally.seconds_refused) += seconds;
  if (!attempt.accepted) {
    ++tally.refused;
    if (pair.same_place) ++tally.reasons[attempt.reason];
    return;
  }
  if (!pair.same_place) {
    ++tally.false_accepted;
    return;
  }
  const RegistrationResult& result = attempt.result;
  const Error error = errorOf(result.target_T_source, result.information, pair.from_T_to);
  ++tally.accepted;
  tally.translation += error.m;
  tally.rotation += error.deg;
  if (error.m <= 0.2 && error.deg <= 2) {
    ++tally.right;
    addCalibration(result, pair.from_T_to, tally);
  } else if (error.m > 1 || error.deg > 5) {
    ++tally.wrong;
  }
}

/** A line of the file of details: errors of start and result, all scores, and, where all directions
 * are known, the squared Mahalanobis error and each axis' by the variance claimed. */
std::string describe(const std::string& start, const TruePair& pair,
                     const LoopClosureAttempt& attempt, const RobotTable& robots) {
  const RegistrationResult& result = attempt.result;
  const Error first = errorOf(result.start, result.information, pair.from_T_to);
  const Error last = errorOf(result.target_T_source, result.information, pair.from_T_to);
  std::ostringstream line;
  line << start << "," << robots.format(pair.candidate.from) << ","
       << robots.format(pair.candidate.to) << "," << pair.same_place << "," << pair.overlap << ","
       << attempt.accepted << "," << attempt.reason << "," << first.m << "," << first.deg << ","
       << last.m << "," << last.deg;
  for (const Score& score : attempt.scores) line << "," << score.name << "=" << score.value;
  if (attempt.accepted && result.unobserved.empty()) {
    const Vector6d d = logSE3(result.target_T_source.inverse() * pair.from_T_to);
    line << ",d2=" << d.dot(result.information * d);
    const Matrix6d covariance = result.information.inverse();
    for (int k = 0; k < 6; ++k) line << ",n" << k << "=" << d[k] * d[k] / covariance(k, k);
  }
  return line.str();
}

void run(const std::string& world, size_t pair_count, unsigned seed,
         const std::vector<std::string>& starts, std::vector<std::string> overrides,
         const std::string& details) {
  registerAllClasses_lamp();
  overrides.insert(overrides.begin(), "pipeline.candidates=");
  Team team(world, overrides);
  std::vector<TruePair> pairs;
  for (const bool same_place : {true, false})
    for (const TruePair& pair :
         drawn(readPairs(world + "/truth/loop_pairs.csv", team.robots(), same_place), pair_count,
               seed))
      pairs.push_back(pair);
  std::ofstream file;
  if (!details.empty()) file.open(details);

  for (const std::string& start : starts) {
    const auto truth = std::make_shared<GroundTruth>();
    const LoopClosureComputation computation = computationFrom(start, truth, team.config());
    Tally tally;
    for (const TruePair& pair : pairs) {
      const PreparedScanPtr source = team.source(pair), target = team.target(pair);
      const Guess guess = team.guess(pair);
      truth->truth = pair.from_T_to;
      const auto begin = std::chrono::steady_clock::now();
      const LoopClosureAttempt attempt = computation.compute(*source, *target, guess);
      const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
      count(pair, attempt, taken.count(), tally);
      if (file.is_open()) file << describe(start, pair, attempt, team.robots()) << "\n";
    }
    printRow(start, tally);
    printCalibration(tally);
  }
}

}  // namespace
}  // namespace lamp

int main(int argc, char** argv) {
  CLI::App app("Table II of the paper on a simulated world");
  std::string world, details;
  size_t pairs = 200;
  unsigned seed = 1;
  std::vector<std::string> overrides,
      starts{"GroundTruth", "OdometryGuess", "OdometryRotationGuess", "Teaser"};
  app.add_option("WORLD", world, "folder made by lamp-sim --keyed")->required();
  app.add_option("--pairs", pairs, "true pairs, and as many false ones");
  app.add_option("--seed", seed, "of the choice of pairs");
  app.add_option("--starts", starts, "initial aligners")->delimiter(',');
  app.add_option("--set", overrides, "section.key=value");
  app.add_option("--details", details, "CSV file with a row for each attempt");
  return lamp::runProgram(app, argc, argv,
                          [&] { lamp::run(world, pairs, seed, starts, overrides, details); });
}
