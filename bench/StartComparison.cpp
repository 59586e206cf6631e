// Table II of the paper on a simulated world: what becomes of true and of false pairs of key nodes
// when the refinement starts from the truth, from odometry's rotation, or from a global alignment.
//
//   StartComparison WORLD [--pairs 200] [--seed 1] [--starts Teaser,SacIa] [--set
//   section.key=value]
#include <CLI/CLI.hpp>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <map>
#include <random>

#include "FrontEndTeam.h"
#include "lamp/base_station/BaseStation.h"
#include "lamp/core/ChiSquare.h"
#include "lamp/core/Csv.h"
#include "lamp/core/Program.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/pose_graph/ShortestPathUncertainty.h"

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

/** Error of a result in the directions that it claims to know. */
Error errorOf(const RegistrationResult& result, const Pose3& truth) {
  Vector6d d = logSE3(result.target_T_source.inverse() * truth);
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(result.information);
  Matrix6d known = Matrix6d::Zero();
  for (int k = 0; k < 6; ++k)
    if (eigen.eigenvalues()[k] > 1e-6 * eigen.eigenvalues()[5])
      known += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose();
  d = known * d;
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

void run(const std::string& world, int count, unsigned seed, const std::vector<std::string>& starts,
         const std::vector<std::string>& overrides, const std::string& details) {
  registerAllClasses_lamp();
  std::vector<std::string> all{"pipeline.candidates="};
  all.insert(all.end(), overrides.begin(), overrides.end());
  const SlamConfig config = SlamConfig::fromFile(world + "/lamp.ini", all, {});
  mrpt::system::CTimeLogger timer(false, "");
  BaseStation base(config, timer);
  RobotTable robots;
  Handover handover(base);
  FrontEndTeam team(config, handover);
  RawlogSource source(config.input.rawlogs, config.robots, robots);
  while (const auto observation = source.next()) team.observe(*observation);
  team.finish();

  std::vector<TruePair> pairs;
  for (const bool same_place : {true, false}) {
    auto some = readPairs(world + "/truth/loop_pairs.csv", robots, same_place);
    std::mt19937 random(seed);
    for (size_t i = some.size(); i > 1; --i) std::swap(some[i - 1], some[random() % i]);
    some.resize(std::min(some.size(), static_cast<size_t>(count)));
    pairs.insert(pairs.end(), some.begin(), some.end());
  }

  PreparedScanStore scans(config.registration.preparation);
  for (const auto& [id, packet] : base.packets()) scans.add(packet);
  const auto prepared = [&](const PreparedScanStore::Key& key) {
    const PreparedScanPtr scan = scans.get(key);
    scan->features();  // here, where it is not timed
    return scan;
  };
  const ShortestPathUncertainty uncertainty(base.graph());
  const std::unique_ptr<FILE, int (*)(FILE*)> file(
      details.empty() ? nullptr : std::fopen(details.c_str(), "w"),
      [](FILE* f) { return f ? std::fclose(f) : 0; });

  for (const std::string& start : starts) {
    Faults faults;
    const auto truth = std::make_shared<GroundTruth>();
    std::shared_ptr<InitialAligner> aligner = truth;
    if (start != "GroundTruth")
      aligner = makeStage<InitialAligner>(StageName::parse(start), "initial aligner", "",
                                          config.ini(), faults);
    faults.throwIfAny();
    const LoopClosureComputation computation(
        {aligner}, config.stages.refiner,
        {config.stages.verifiers.begin(), config.stages.verifiers.end()},
        config.registration.ambiguity);
    Tally tally;
    for (const TruePair& pair : pairs) {
      const auto a = prepared(scans.target(pair.candidate));
      const auto b = prepared(scans.source(pair.candidate));
      truth->truth = pair.from_T_to;
      Guess guess{base.graph().node(pair.candidate.from).world_T_base.inverse() *
                      base.graph().node(pair.candidate.to).world_T_base,
                  std::nullopt};
      const auto covariance =
          uncertainty.relativeCovariances(pair.candidate.from, {pair.candidate.to});
      guess.covariance = covariance[0];
      const auto begin = std::chrono::steady_clock::now();
      const LoopClosureAttempt attempt = computation.compute(*b, *a, guess);
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
      (pair.same_place ? tally.true_pairs : tally.false_pairs)++;
      (attempt.accepted ? tally.seconds_accepted : tally.seconds_refused) += seconds;
      const Error error = errorOf(attempt.result, pair.from_T_to);
      if (file) {
        std::fprintf(file.get(), "%s,%s,%s,%d,%.3f,%d,%s,%.3f,%.3f", start.c_str(),
                     robots.format(pair.candidate.from).c_str(),
                     robots.format(pair.candidate.to).c_str(), pair.same_place, pair.overlap,
                     attempt.accepted, attempt.reason.c_str(), error.m, error.deg);
        const Error start_error = errorOf(
            [&] {
              auto r = attempt.result;
              r.target_T_source = r.start;
              return r;
            }(),
            pair.from_T_to);
        std::fprintf(file.get(), ",start %.2f %.1f", start_error.m, start_error.deg);
        for (const Score& score : attempt.scores)
          std::fprintf(file.get(), ",%s=%.4f", score.name.c_str(), score.value);
        std::fprintf(file.get(), "\n");
      }
      if (!attempt.accepted) {
        ++tally.refused;
        if (pair.same_place) ++tally.reasons[attempt.reason];
        continue;
      }
      if (!pair.same_place) {
        ++tally.false_accepted;
        continue;
      }
      ++tally.accepted;
      tally.translation += error.m;
      tally.rotation += error.deg;
      if (error.m <= 0.2 && error.deg <= 2) {
        ++tally.right;
        addCalibration(attempt.result, pair.from_T_to, tally);
      } else if (error.m > 1 || error.deg > 5)
        ++tally.wrong;
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
  int pairs = 200;
  unsigned seed = 1;
  std::vector<std::string> overrides,
      starts{"GroundTruth", "Odometry", "OdometryRotation", "Teaser"};
  app.add_option("WORLD", world, "folder made by lamp-sim --keyed")->required();
  app.add_option("--pairs", pairs, "true pairs, and as many false ones");
  app.add_option("--seed", seed, "of the choice of pairs");
  app.add_option("--starts", starts, "initial aligners")->delimiter(',');
  app.add_option("--set", overrides, "section.key=value");
  app.add_option("--details", details, "CSV file with a row for each attempt");
  return lamp::runProgram(app, argc, argv,
                          [&] { lamp::run(world, pairs, seed, starts, overrides, details); });
}
