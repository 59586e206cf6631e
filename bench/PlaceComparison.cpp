// Place recognition: which descriptor of a key node finds the places that a robot has been to, with
// no pose at all. Single scans, and local maps of the way around a key node.
//
//   PlaceComparison INI [RAWLOG...] [--truth DIR] [--near 3] [--far 10] [--set key=value]
//
// For each key node that lies within --near of an earlier one of its own robot (20 m of its way ago
// at least) or of one of another robot, the most similar one is looked up. Right is within --near,
// false beyond --far. `at 1 %` is the share that is found right where one in a hundred of the
// answers is false.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "FrontEndTeam.h"
#include "lamp/core/Program.h"
#include "lamp/core/Trajectory.h"
#include "lamp/input/RawlogSource.h"
#include "lamp/scans/PlaceDescriptor.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp {
namespace {

using Points = std::vector<Eigen::Vector3f>;

struct Place {
  KeyNodePacket packet;
  double travelled_m = 0;
  Eigen::Vector3d truth = Eigen::Vector3d::Zero();
};

class Collector : public MessageSender {
 public:
  std::vector<KeyNodePacket> packets;
  bool send(Message message) override {
    if (const auto* packet = std::get_if<KeyNodePacket>(&message)) packets.push_back(*packet);
    return true;
  }
};

struct Limits {
  double near_m = 3, far_m = 10;
};

std::vector<Place> readPlaces(const SlamConfig& config, const std::string& truth) {
  Collector collector;
  RobotTable robots;
  FrontEndTeam front_ends(config, collector);
  RawlogSource source(config.input.rawlogs, config.robots, robots);
  while (const auto observation = source.next()) front_ends.observe(*observation);
  front_ends.finish();
  std::stable_sort(collector.packets.begin(), collector.packets.end(),
                   [](const auto& a, const auto& b) { return a.id < b.id; });
  std::map<RobotId, TrajectoryInterpolator> truths;
  std::vector<Place> places;
  for (const KeyNodePacket& packet : collector.packets) {
    Place place{packet, 0, packet.odom_T_base.translation()};
    if (!places.empty() && places.back().packet.id.robot == packet.id.robot)
      place.travelled_m =
          places.back().travelled_m +
          (places.back().packet.odom_T_base.inverse() * packet.odom_T_base).translation().norm();
    const RobotId robot = packet.id.robot;
    if (!truth.empty()) {
      if (truths.count(robot) == 0)
        truths.emplace(robot,
                       TrajectoryInterpolator(readTum(truth + "/" + robots.name(robot) + ".tum")));
      place.truth = truths.at(robot).at(packet.stamp).translation();
    }
    places.push_back(std::move(place));
  }
  return places;
}

/** What the scans along the way up to `reach_m` before and after show, in the level frame. */
Points localMap(const std::vector<Place>& places, size_t i, double reach_m, double radius_m) {
  const Place& here = places[i];
  const Pose3 level_T_odom =
      Pose3(levelFrame(here.packet.odom_T_base)) * here.packet.odom_T_base.inverse();
  std::vector<PlacedScan> scans;
  for (const Place& other : places)
    if (other.packet.id.robot == here.packet.id.robot &&
        std::abs(other.travelled_m - here.travelled_m) <= reach_m)
      scans.push_back({other.packet.scan, level_T_odom * other.packet.odom_T_base});
  return surroundings(scans, radius_m, here.packet.planar);
}

/** Scan Context (Kim, Kim, IROS 2018): the highest point of each cell of 20 rings and 60 sectors;
 * the distance is that of the columns' directions, at the best heading. */
Eigen::MatrixXf scanContext(const Points& points, float radius_m) {
  Eigen::MatrixXf highest = Eigen::MatrixXf::Zero(20, 60);
  for (const Eigen::Vector3f& p : points) {
    const float range = p.head<2>().norm();
    if (range >= radius_m) continue;
    const double turns = std::atan2(p.y(), p.x()) / (2 * M_PI);
    const int ring = static_cast<int>(range / radius_m * 20);
    const int sector = static_cast<int>((turns - std::floor(turns)) * 60) % 60;
    highest(ring, sector) = std::max({highest(ring, sector), 0.01F, p.z() + 2});
  }
  for (auto column : highest.colwise())
    if (column.norm() > 0) column.normalize();
  return highest;
}

double similarity(const Eigen::MatrixXf& a, const Eigen::MatrixXf& b) {
  const auto sectors = a.cols();
  double best = 0;
  for (Eigen::Index shift = 0; shift < sectors; ++shift) {
    float sum = a.leftCols(sectors - shift).cwiseProduct(b.rightCols(sectors - shift)).sum();
    if (shift > 0) sum += a.rightCols(shift).cwiseProduct(b.leftCols(shift)).sum();
    best = std::max(best, static_cast<double>(sum));
  }
  return best;
}

/** How many points lie in each of 20 rings and 6 layers of height, as SOLiD has them (Kim et al.,
 * RA-L 2024). */
Eigen::VectorXf ringHistogram(const Points& points, float radius_m) {
  Eigen::VectorXf counts = Eigen::VectorXf::Zero(120);
  for (const Eigen::Vector3f& p : points) {
    const float range = p.head<2>().norm();
    if (range >= radius_m) continue;
    const int layer = std::clamp(static_cast<int>(std::floor(p.z() + 2)), 0, 5);
    counts[static_cast<int>(range / radius_m * 20) * 6 + layer] += 1;
  }
  return counts.cwiseSqrt().normalized();
}

using Similarity = std::function<double(size_t, size_t)>;

void judge(const std::string& name, const std::vector<Place>& places, const Limits& limits,
           const Similarity& similarity) {
  constexpr double kBefore_m = 20;
  std::vector<std::pair<double, double>> answers;  // similarity; distance of the place found
  size_t revisits = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    bool revisit = false;
    std::pair<double, double> best{-1, 0};
    for (size_t j = 0; j < places.size(); ++j) {
      const bool own = places[i].packet.id.robot == places[j].packet.id.robot;
      if (own && places[j].travelled_m + kBefore_m > places[i].travelled_m) continue;
      const double distance_m = (places[i].truth - places[j].truth).norm();
      revisit = revisit || distance_m <= limits.near_m;
      best = std::max(best, {similarity(i, j), -distance_m});
    }
    if (best.first < 0) continue;
    revisits += revisit ? 1 : 0;
    answers.emplace_back(best.first, -best.second);
  }
  std::sort(answers.rbegin(), answers.rend());
  size_t right = 0, wrong = 0, right_at_1_percent = 0;
  for (const auto& [value, distance_m] : answers) {
    right += distance_m <= limits.near_m ? 1 : 0;
    wrong += distance_m > limits.far_m ? 1 : 0;
    if (wrong * 100 <= right + wrong) right_at_1_percent = right;
  }
  const double all = static_cast<double>(std::max<size_t>(revisits, 1)) / 100;
  std::printf("%-32s %5zu revisits  best is right %5.1f %%  at 1 %% false %5.1f %%\n", name.c_str(),
              revisits, static_cast<double>(right) / all,
              static_cast<double>(right_at_1_percent) / all);
  std::fflush(stdout);
}

/** One for each local map. */
template <class Make>
auto made(const std::vector<Points>& maps, const Make& make) {
  std::vector<decltype(make(maps.front()))> result;
  for (const Points& map : maps) result.push_back(make(map));
  return result;
}

void run(const std::string& ini, const std::vector<std::string>& rawlogs, const std::string& truth,
         const Limits& limits, const std::vector<std::string>& overrides) {
  registerAllClasses_lamp();
  const SlamConfig config = SlamConfig::fromFile(ini, overrides, rawlogs);
  const std::vector<Place> places = readPlaces(config, truth);
  if (places.empty()) throw std::runtime_error("no key nodes");
  const bool planar = places.front().packet.planar;
  const float radius_m = planar ? 15 : 60;
  for (const double reach_m : {0.0, 10.0}) {
    const std::string of = reach_m > 0 ? ", local map" : ", single scan";
    std::vector<Points> maps;
    for (size_t i = 0; i < places.size(); ++i)
      maps.push_back(localMap(places, i, reach_m, radius_m));
    const auto spectra =
        made(maps, [&](const Points& map) { return PlaceDescriptor(map, radius_m, planar); });
    judge("polar spectrum" + of, places, limits,
          [&](size_t i, size_t j) { return match(spectra[i], spectra[j]).similarity; });
    judge("its magnitudes" + of, places, limits, [&](size_t i, size_t j) {
      return static_cast<double>(spectra[i].magnitudes().dot(spectra[j].magnitudes()));
    });
    const auto contexts = made(maps, [&](const Points& map) { return scanContext(map, radius_m); });
    judge("Scan Context" + of, places, limits,
          [&](size_t i, size_t j) { return similarity(contexts[i], contexts[j]); });
    const auto rings = made(maps, [&](const Points& map) { return ringHistogram(map, radius_m); });
    judge("rings and heights" + of, places, limits,
          [&](size_t i, size_t j) { return static_cast<double>(rings[i].dot(rings[j])); });
  }
}

}  // namespace
}  // namespace lamp

int main(int argc, char** argv) {
  CLI::App app("Which descriptor of a key node finds the places that a robot has been to");
  std::string ini, truth;
  std::vector<std::string> rawlogs, overrides;
  lamp::Limits limits;
  app.add_option("INI", ini, "experiment file of lamp-slam")->required();
  app.add_option("RAWLOG", rawlogs, "recordings beside those of the ini");
  app.add_option("--truth", truth, "folder with a TUM file for each robot; odometry without");
  app.add_option("--near", limits.near_m, "a place found within so many metres is right");
  app.add_option("--far", limits.far_m, "a place found farther away is false");
  app.add_option("--set", overrides, "section.key=value")->expected(1)->allow_extra_args(false);
  return lamp::runProgram(app, argc, argv,
                          [&] { lamp::run(ini, rawlogs, truth, limits, overrides); });
}
