// Our registration beside PCL's on pairs of real scans, moved by any yaw and up to 10 m: how often
// it is right, and how long it takes. One thread, one run: the ratios count.
//
//   RegistrationPeers [DATA] [--pairs 40] [--seed 1] [--without-peer]
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <thread>

#include "RegistrationComparison.h"
#include "lamp/core/Program.h"

namespace lamp {
namespace {

using Comparisons = std::vector<Comparison>;
using Property = std::function<bool(const Comparison&)>;

double percentOf(const Comparisons& all, const Property& property) {
  const auto count = std::count_if(all.begin(), all.end(), property);
  return 100.0 * static_cast<double>(count) / static_cast<double>(std::max<size_t>(1, all.size()));
}

void printRates(const std::string& name, const Comparisons& all) {
  const auto rate = [&](const Property& property) { return percentOf(all, property); };
  std::printf("%s: %zu pairs, %.0f %% observe all directions\n", name.c_str(), all.size(),
              rate([](const Comparison& c) { return c.ours.observes_all; }));
  std::printf("  right, %%                accepted  all   wrong and accepted  GICP alone\n");
  std::printf("    ours                 %9.1f %5.1f %14.1f %13.1f\n",
              rate([](const Comparison& c) { return c.ours.accepted && c.ours.right; }),
              rate([](const Comparison& c) { return c.ours.right_unverified; }),
              rate([](const Comparison& c) { return c.ours.accepted && !c.ours.right; }),
              rate([](const Comparison& c) { return c.ours.gicp_right; }));
  if (all.empty() || !all.front().peer) return;
  std::printf("    PCL SAC-IA + GICP    %9.1f %5.1f %14.1f %13.1f\n",
              rate([](const Comparison& c) { return c.peer->accepted && c.peer->right; }),
              rate([](const Comparison& c) { return c.peer->right; }),
              rate([](const Comparison& c) { return c.peer->accepted && !c.peer->right; }),
              rate([](const Comparison& c) { return c.peer->gicp_right; }));
}

void printRefusals(const Comparisons& all) {
  std::map<std::string, int> refusals;
  for (const Comparison& c : all)
    if (!c.ours.accepted) ++refusals[c.ours.refusal + (c.ours.right ? " (right)" : "")];
  for (const auto& [reason, count] : refusals) std::printf("    %3d %s\n", count, reason.c_str());
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

/** Medians over the pairs that `use` picks; the ratio is the median of the pairs' ratios. */
void printTimes(const char* name, const Comparisons& all, double Outcome::*time,
                const std::function<bool(const Outcome&)>& use) {
  std::vector<double> our_times, peer_times, ratios;
  for (const Comparison& c : all) {
    if (!use(c.ours)) continue;
    our_times.push_back(c.ours.*time);
    if (!c.peer) continue;
    peer_times.push_back((*c.peer).*time);
    ratios.push_back(c.ours.*time / ((*c.peer).*time));
  }
  std::printf("  %-22s %4zu %8.2f", name, our_times.size(), median(our_times));
  if (!ratios.empty())
    std::printf(" %8.2f   %.4f = 1/%.1f", median(peer_times), median(ratios), 1 / median(ratios));
  std::printf("\n");
}

void printAllTimes(const Comparisons& all) {
  const auto any = [](const Outcome&) { return true; };
  std::printf("median ms               pairs     ours      PCL   ratio\n");
  printTimes("candidate, accepted", all, &Outcome::candidate,
             [](const Outcome& o) { return o.accepted; });
  printTimes("candidate, refused", all, &Outcome::candidate,
             [](const Outcome& o) { return !o.accepted; });
  printTimes("GICP alone", all, &Outcome::gicp, any);
  printTimes("preparation", all, &Outcome::preparation, any);
  std::fflush(stdout);
}

/** Prepares and registers every second pair. */
void computeHalf(const OurRegistration& ours, const std::vector<RecordedPair>& pairs,
                 size_t which) {
  for (size_t i = which; i < pairs.size(); i += 2)
    ours.verified.compute(*ours.prepare(pairs[i].source), *ours.prepare(pairs[i].target), {});
}

void inTwoThreads(const OurRegistration& ours, const std::vector<RecordedPair>& pairs) {
  std::thread other([&] { computeHalf(ours, pairs, 1); });
  computeHalf(ours, pairs, 0);
  other.join();
}

void inTwoProcesses(const OurRegistration& ours, const std::vector<RecordedPair>& pairs) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a second process");
  computeHalf(ours, pairs, child == 0 ? 1 : 0);
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
}

void printThroughput(const OurRegistration& ours, const std::vector<RecordedPair>& pairs) {
  constexpr int kRounds = 5;
  std::vector<double> threads, processes;
  for (int round = 0; round < kRounds; ++round) {
    processes.push_back(millisecondsOf([&] { inTwoProcesses(ours, pairs); }));
    threads.push_back(millisecondsOf([&] { inTwoThreads(ours, pairs); }));
  }
  std::printf(
      "%zu pairs prepared and registered: two threads %.0f ms, two processes %.0f ms, "
      "throughput ratio %.2f\n",
      pairs.size(), median(threads), median(processes), median(processes) / median(threads));
}

std::string dataFolder(const std::string& given) {
  if (!given.empty()) return given;
  const char* from_environment = std::getenv("LAMP_DATA");
  return from_environment ? from_environment : "../shared/data";
}

struct OverlapClassName {
  OverlapClass overlap;
  const char* name;
};
constexpr std::array<OverlapClassName, 2> kClasses{
    {{{0.5, 1.01}, "overlap >= 0.5"}, {{0.3, 0.5}, "overlap 0.3 - 0.5"}}};

Comparisons compareOnAll(const std::vector<RecordedPair>& pairs, const OurRegistration& ours,
                         bool with_peer) {
  Comparisons all;
  for (const RecordedPair& pair : pairs) all.push_back(compareOn(pair, ours, with_peer));
  return all;
}

void printOverlapClasses(const std::string& recording, const Comparisons& all) {
  for (const auto& [range, name] : kClasses) {
    Comparisons some;
    const OverlapClass& of_class = range;
    std::copy_if(all.begin(), all.end(), std::back_inserter(some), [&](const Comparison& c) {
      return c.overlap >= of_class.least && c.overlap < of_class.below;
    });
    printRates(recording + ", " + name, some);
    printRefusals(some);
  }
}

void run(const std::string& data, size_t count, unsigned seed, bool with_peer,
         const std::vector<std::string>& overrides) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> recordings{
      {"mulran_kaist03", {data + "/mulran_kaist03/car.rawlog"}},
      {"balm_indoor", {data + "/balm_indoor/robotA.rawlog", data + "/balm_indoor/robotB.rawlog"}}};
  registerAllClasses_lamp();
  Faults faults;
  Ini ini;
  for (const std::string& assignment : overrides) ini.set(assignment, faults);
  const OurRegistration ours{SlamConfig(std::move(ini), std::move(faults))};
  std::srand(seed);  // SAC-IA draws its samples by std::rand
  std::vector<RecordedPair> all_pairs;
  Comparisons all;
  for (const auto& [name, rawlogs] : recordings) {
    const std::vector<RecordedPair> pairs =
        recordedPairs(rawlogs, {kClasses[0].overlap, kClasses[1].overlap}, count, seed);
    const Comparisons comparisons = compareOnAll(pairs, ours, with_peer);
    printOverlapClasses(name, comparisons);
    all.insert(all.end(), comparisons.begin(), comparisons.end());
    all_pairs.insert(all_pairs.end(), pairs.begin(), pairs.end());
  }
  printAllTimes(all);
  printThroughput(ours, all_pairs);
}

}  // namespace
}  // namespace lamp

int main(int argc, char** argv) {
  CLI::App app("Our registration beside PCL's on real scans");
  std::string data;
  size_t pairs = 40;
  unsigned seed = 1;
  bool without_peer = false;
  app.add_option("DATA", data, "folder with the recordings; else $LAMP_DATA, or ../shared/data");
  app.add_option("--pairs", pairs, "of each recording and each class of overlap");
  app.add_option("--seed", seed, "of the choice of pairs and their motions");
  std::vector<std::string> overrides;
  app.add_option("--set", overrides, "section.key=value of ours");
  app.add_flag("--without-peer", without_peer, "measure only ours");
  return lamp::runProgram(app, argc, argv, [&] {
    lamp::run(lamp::dataFolder(data), pairs, seed, !without_peer, overrides);
  });
}
