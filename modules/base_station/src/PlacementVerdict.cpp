#include "lamp/base_station/PlacementVerdict.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace lamp {

namespace {

/** Placements that bring less than this share of what the best one does together do not count:
 * some stretch of wall fits another one everywhere. */
constexpr double kLeastShare = 0.5;
/** One patch more may be noise, or somebody passing. */
constexpr double kNoisePatches = 1.0;
/** Noise, edges and moving objects contradict, too. */
constexpr double kExcess = 2.0;
/** A placement is refuted if this many more pairs contradict it than chance explains, plus this
 * many standard deviations. */
constexpr double kFewestPairs = 4.0, kDeviations = 2.0;
/** Patches are distinctive if they contradict at least this many refuted placements; fewer patches
 * tell nothing. */
constexpr size_t kFewestRefuted = 3;
constexpr double kFewestDistinctive = 10.0;

/** Right placements have at most 0.012 of this in simulated and real recordings, wrong ones in a
 * world that does not repeat itself at least 0.06. */
constexpr double kMaxContradicting = 0.05;

using SeenPatch = std::pair<KeyNodeId, Patch>;

double contradictingShare(const ComparedPair& pair) {
  return pair.contradicting() / std::max(1.0, pair.contradicting() + pair.agreeing());
}

double contradictingShare(const Placement& placement) {
  double agreeing = 1, contradicting = 0;
  for (const ComparedPair& pair : placement.pairs) {
    agreeing += pair.agreeing();
    contradicting += pair.contradicting();
  }
  return contradicting / (agreeing + contradicting);
}

/** Share of contradicting patches that three quarters of the pairs stay below. */
double usualShare(const Placement& placement) {
  std::vector<double> shares{0};
  for (const ComparedPair& pair : placement.pairs) shares.push_back(contradictingShare(pair));
  const auto upper = shares.begin() + static_cast<std::ptrdiff_t>(3 * (shares.size() - 1) / 4);
  std::nth_element(shares.begin(), upper, shares.end());
  return *upper;
}

/** Pairs that contradict by more than is usual. */
double contradicted(const Placement& placement, double usual) {
  return static_cast<double>(
      std::count_if(placement.pairs.begin(), placement.pairs.end(), [&](const auto& pair) {
        return pair.contradicting() > kNoisePatches && contradictingShare(pair) > kExcess * usual;
      }));
}

bool refuted(const Placement& placement, const Placement& by) {
  const double usual = usualShare(by);
  const double by_chance = contradicted(by, usual) /
                           std::max(1.0, static_cast<double>(by.pairs.size())) *
                           static_cast<double>(placement.pairs.size());
  return contradicted(placement, usual) >=
         by_chance + kFewestPairs + kDeviations * std::sqrt(by_chance);
}

/** What refutes placements: patches that contradict several of them. */
std::set<SeenPatch> distinctivePatches(const std::vector<const Placement*>& refuted) {
  std::map<SeenPatch, size_t> count;
  for (const Placement* placement : refuted) {
    std::set<SeenPatch> seen;
    for (const ComparedPair& pair : placement->pairs) {
      for (const Patch& patch : pair.of_a.contradicting) seen.insert({pair.a, patch});
      for (const Patch& patch : pair.of_b.contradicting) seen.insert({pair.b, patch});
    }
    for (const SeenPatch& patch : seen) ++count[patch];
  }
  std::set<SeenPatch> distinctive;
  for (const auto& [patch, placements] : count)
    if (placements >= kFewestRefuted) distinctive.insert(patch);
  return distinctive;
}

/** How many of them a placement brings together with what the other robot has seen. */
double explained(const Placement& placement, const std::set<SeenPatch>& patches) {
  size_t count = 0;
  for (const ComparedPair& pair : placement.pairs) {
    for (const Patch& patch : pair.of_a.agreeing) count += patches.count({pair.a, patch});
    for (const Patch& patch : pair.of_b.agreeing) count += patches.count({pair.b, patch});
  }
  return static_cast<double>(count) * placement.near /
         std::max(1.0, static_cast<double>(placement.pairs.size()));
}

/** Those that bring a good part of the maps together, least contradicted first. */
std::vector<size_t> candidates(const std::vector<Placement>& placements) {
  double most = 0;
  for (const Placement& placement : placements) most = std::max(most, placement.agreeing());
  std::vector<size_t> result;
  for (size_t k = 0; k < placements.size(); ++k)
    if (placements[k].agreeing() >= kLeastShare * most) result.push_back(k);
  std::stable_sort(result.begin(), result.end(), [&](size_t i, size_t j) {
    return contradictingShare(placements[i]) < contradictingShare(placements[j]);
  });
  return result;
}

}  // namespace

PlacementVerdict judge(const std::vector<Placement>& placements) {
  std::vector<size_t> left;
  std::vector<const Placement*> out;
  const std::vector<size_t> all = candidates(placements);
  for (const size_t k : all)
    if (refuted(placements[k], placements[all.front()]))
      out.push_back(&placements[k]);
    else
      left.push_back(k);

  const std::set<SeenPatch> distinctive = distinctivePatches(out);
  std::vector<double> explains;
  for (const Placement& placement : placements)
    explains.push_back(explained(placement, distinctive));
  const auto most = *std::max_element(
      left.begin(), left.end(), [&](size_t i, size_t j) { return explains[i] < explains[j]; });
  const bool distinct = explains[most] >= kFewestDistinctive;
  PlacementVerdict verdict;
  verdict.best = distinct ? most : left.front();
  for (const size_t k : left)
    if (k != verdict.best && (!distinct || explains[k] >= kLeastShare * explains[most]))
      verdict.equally_good.push_back(k);
  verdict.contradicting = contradictingShare(placements[verdict.best]);
  verdict.contradicted = verdict.contradicting > kMaxContradicting;
  return verdict;
}

}  // namespace lamp
