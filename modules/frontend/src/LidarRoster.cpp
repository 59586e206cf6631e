#include "LidarRoster.h"

#include <algorithm>
#include <utility>

#include "lamp/core/Csv.h"
#include "lamp/input/ScanFromObservation.h"

namespace lamp {

namespace {

/** No more lidars than this share a label; one in more places is on a mount that moves. */
constexpr size_t kMostMounts = 4;
/** Lidars that share a label lie farther apart, and have taken turns so often. */
constexpr double kApartM = 0.05;
constexpr int kEnoughTurns = 5;
/** Poses that are the same are the same to this. */
constexpr double kSame = 1e-6;

/** A lidar that has given nothing for this time, and this many of its intervals, is silent. */
constexpr double kSilentS = 2.0, kSilentFactor = 5.0;
/** A sensor that gives nothing for longer does not talk. */
constexpr double kTalksS = 1.0;

bool same(const Pose3& a, const Pose3& b) {
  return a.isApprox(b, kSame);
}

Pose3 sensorPoseOf(const InputObservation& observation) {
  mrpt::poses::CPose3D pose;
  observation.observation->getSensorPose(pose);
  return Pose3(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
}

}  // namespace

bool LidarRoster::Label::shared() const {
  return !moves && mounts.size() > 1 &&
         std::all_of(mounts.begin(), mounts.end(),
                     [](const Mount& mount) { return mount.turns >= kEnoughTurns; });
}

InputObservation LidarRoster::take(InputObservation observation) {
  if (!isLidar(*observation.observation)) {
    hear(observation);
  } else {
    const Pose3 base_T_sensor = sensorPoseOf(observation);
    const InputObservation recorded = observation;
    observation.label = nameOf(observation, base_T_sensor);
    const auto [found, is_new] = lidars_.try_emplace(observation.label);
    Lidar& lidar = found->second;
    if (is_new)
      lidar.base_T_sensor = base_T_sensor;
    else
      noteSilence(lidar);
    hear(recorded);
    noteScan(lidar, observation.stamp);
  }
  return observation;
}

void LidarRoster::hear(const InputObservation& observation) {
  const auto [found, is_new] = voices_.try_emplace(observation.label);
  Voice& voice = found->second;
  if (!is_new) voice.talk_s += std::clamp(observation.stamp - voice.last, 0.0, kTalksS);
  voice.last = observation.stamp;
}

/** By the sensor that has talked for longest. */
double LidarRoster::talkSince(const Lidar& lidar) const {
  double most = 0;
  for (const auto& [label, voice] : voices_) {
    const auto before = lidar.heard.find(label);
    most = std::max(most, voice.talk_s - (before == lidar.heard.end() ? 0 : before->second));
  }
  return most;
}

std::string LidarRoster::nameOf(const InputObservation& observation, const Pose3& base_T_sensor) {
  Label& label = labels_[observation.label];
  if (label.moves) return observation.label;
  auto& mounts = label.mounts;
  auto mount = std::find_if(mounts.begin(), mounts.end(),
                            [&](const Mount& m) { return same(m.base_T_sensor, base_T_sensor); });
  if (mount == mounts.end()) {
    label.moves =
        mounts.size() == kMostMounts ||
        std::any_of(mounts.begin(), mounts.end(), [&](const Mount& m) {
          return (m.base_T_sensor.translation() - base_T_sensor.translation()).norm() < kApartM;
        });
    mount = mounts.insert(mounts.end(), {base_T_sensor, 0});
  }
  const auto place = static_cast<size_t>(mount - mounts.begin());
  if (std::exchange(label.last, place) != place) ++mount->turns;
  if (place == 0 || !label.shared()) return observation.label;
  return observation.label + " " + std::to_string(place + 1);
}

/** A pause of the recording is no interval. */
void LidarRoster::noteScan(Lidar& lidar, double stamp) {
  if (lidar.last > 0) {
    const double interval = stamp - lidar.last;
    lidar.interval_s = lidar.interval_s ? std::min(interval, 2 * *lidar.interval_s) : interval;
  }
  lidar.last = stamp;
  for (const auto& [label, voice] : voices_) lidar.heard[label] = voice.talk_s;
}

double LidarRoster::longestPause(const Lidar& lidar) {
  return std::max(kSilentS, kSilentFactor * lidar.interval_s.value_or(kSilentS));
}

bool LidarRoster::isSilent(const std::string& name, double stamp) const {
  const Lidar& lidar = lidars_.at(name);
  return stamp - lidar.last > longestPause(lidar);
}

/** Where nothing else spoke, the recording paused. */
void LidarRoster::noteSilence(Lidar& lidar) const {
  const double silent = talkSince(lidar);
  if (silent <= longestPause(lidar)) return;
  if (!lidar.first_silent) lidar.first_silent = lidar.last;
  lidar.silent_s += silent;
}

std::vector<std::string> LidarRoster::mountWarnings() const {
  std::vector<std::pair<Pose3, std::vector<std::string>>> places;
  for (const auto& [name, lidar] : lidars_) {
    auto place = std::find_if(places.begin(), places.end(), [&, &l = lidar](const auto& p) {
      return same(p.first, l.base_T_sensor);
    });
    if (place == places.end())
      place = places.insert(place, {lidar.base_T_sensor, std::vector<std::string>()});
    place->second.push_back("'" + name + "'");
  }
  std::vector<std::string> result;
  for (const auto& [base_T_sensor, names] : places) {
    if (names.size() < 2) continue;
    std::string list = names.front();
    for (size_t i = 1; i < names.size(); ++i)
      list += (i + 1 < names.size() ? ", " : " and ") + names[i];
    result.push_back("the lidars " + list +
                     " are recorded as mounted in the same place and direction: look for "
                     "extrinsics (sensorPose) that are missing");
  }
  return result;
}

std::vector<std::string> LidarRoster::warnings() const {
  std::vector<std::string> result;
  for (const auto& [name, label] : labels_)
    if (label.shared())
      result.push_back(std::to_string(label.mounts.size()) + " lidars have the label '" + name +
                       "': they are told apart by where they are mounted; give each its own");
  for (std::string& warning : mountWarnings()) result.push_back(std::move(warning));
  for (auto [name, lidar] : lidars_) {
    noteSilence(lidar);
    if (lidar.first_silent && !lidar.excused)
      result.push_back("the lidar '" + name + "' gives nothing for " +
                       formatFixed(lidar.silent_s, 1) + " s, first after " +
                       formatFixed(*lidar.first_silent, 3));
  }
  return result;
}

}  // namespace lamp
