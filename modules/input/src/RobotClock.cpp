#include "RobotClock.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace lamp {

namespace {

constexpr size_t kRecent = 5;
/** More stamps of one sensor in a row than these are no single faults. */
constexpr size_t kMaxAhead = 2;
/** So many of a sensor that are in order outvote one before them. */
constexpr size_t kOutvote = 3;
/** So many behind their sensors' last stamps, and hardly one that is not, show that the clock was
 * set back. */
constexpr size_t kStepObservations = 10;
constexpr size_t kMaxInOrder = 2;
/** Stamps are stored in steps of 100 ns. */
constexpr double kResolution = 1e-6;

size_t countFrom(const std::deque<TimeSorter::Key>& recent, double stamp) {
  return static_cast<size_t>(std::count_if(recent.begin(), recent.end(),
                                           [&](const auto& key) { return key.first >= stamp; }));
}

void move(InputObservation& observation, double seconds) {
  auto& timestamp = observation.observation->timestamp;
  timestamp = mrpt::Clock::fromDouble(observation.stamp + seconds);
  observation.stamp = mrpt::Clock::toDouble(timestamp);  // both rounded alike
}

}  // namespace

LabelReport& RobotClock::report(const InputObservation& observation) {
  return registry_.label(robot_, observation.label, *observation.observation);
}

void RobotClock::take(InputObservation observation) {
  if (offset_ != 0) move(observation, offset_);
  const double stamp = observation.stamp;
  seen_.add(stamp);
  const auto [found, is_new] =
      tracks_.try_emplace({observation.label, report(observation).class_name});
  Track& track = found->second;
  if (is_new) track.first = stamp;
  compare(track, observation);
  const bool behind = !track.recent.empty() && stamp <= track.recent.back().first;
  if (!behind) {
    drop(track);
    copied_ = false;
    in_order_ = held_ == 0 ? 0 : in_order_ + 1;
    pass(track, observation);
  } else if (stamp == track.recent.back().first) {
    ++report(observation).repeated;
  } else if (held_ == 0 && track.recent.back().first > seen_.value() + TimeSorter::kWindow &&
             takeBack(track, stamp)) {
    pass(track, observation);
  } else {
    hold(track, observation);
  }
}

/** What is recorded between two lidar scans should have a stamp between theirs. */
void RobotClock::compare(Track& track, const InputObservation& observation) {
  LabelReport& counts = report(observation);
  if (!counts.lidar) {
    if (!track.beside) track.beside = observation.stamp;
    counts.clock = track.clock;
    return;
  }
  const auto [first, last] = std::minmax({lidar_.value_or(observation.stamp), observation.stamp});
  for (auto& [sensor, other] : tracks_) {
    const auto stamp = std::exchange(other.beside, std::nullopt);
    if (!stamp || !lidar_) continue;
    other.clock.add(*stamp - std::clamp(*stamp, first, last));
  }
  lidar_ = observation.stamp;
}

void RobotClock::finish() {
  for (auto& [sensor, track] : tracks_) drop(track);
}

void RobotClock::pass(Track& track, const InputObservation& observation) {
  report(observation).use(observation.stamp);
  track.recent.push_back(sorter_.push(observation));
  if (track.recent.size() > kRecent) track.recent.pop_front();
}

void RobotClock::hold(Track& track, const InputObservation& observation) {
  if (!track.held.empty() && observation.stamp <= track.held.back().stamp) {
    ++report(observation).backwards;
    return;
  }
  track.held.push_back(observation);
  ++held_;
  copied_ = copied_ || observation.stamp == track.first;
  if (track.held.size() == kOutvote && takeBack(track, track.held.front().stamp))
    release(track);
  else if (held_ >= kStepObservations)
    setBack();
}

/** Takes back what the track has passed on from `stamp` on, if that is little and not used yet. */
bool RobotClock::takeBack(Track& track, double stamp) {
  const size_t count = countFrom(track.recent, stamp);
  if (count > kMaxAhead) return false;
  for (size_t i = 0; i < count; ++i) {
    const InputObservation* const ahead = sorter_.find(track.recent.back());
    if (!ahead) return false;
    LabelReport& counts = report(*ahead);
    ++counts.ahead;
    --counts.used;
    sorter_.withdraw(track.recent.back());
    track.recent.pop_back();
  }
  return true;
}

void RobotClock::release(Track& track) {
  held_ -= track.held.size();
  for (const InputObservation& observation : track.held) pass(track, observation);
  track.held.clear();
}

void RobotClock::drop(Track& track) {
  held_ -= track.held.size();
  for (const InputObservation& observation : track.held) ++report(observation).backwards;
  track.held.clear();
}

/** The least that brings all sensors on, and for one of them one period further. */
double RobotClock::stepBack() const {
  double least = -std::numeric_limits<double>::infinity();
  double likely = std::numeric_limits<double>::infinity();
  for (const auto& [sensor, track] : tracks_) {
    if (track.held.empty()) continue;
    const double last = track.recent.back().first;
    const double back = last - track.held.front().stamp;
    const double period = (last - track.recent.front().first) /
                          static_cast<double>(std::max<size_t>(1, track.recent.size() - 1));
    least = std::max(least, back);
    likely = std::min(likely, back + period);
  }
  return std::max(least + kResolution, likely);
}

void RobotClock::setBack() {
  if (copied_ || in_order_ > kMaxInOrder) {
    in_order_ = 0;
    for (auto& [sensor, track] : tracks_) drop(track);
    return;
  }
  const double seconds = stepBack();
  ClockStep step{std::numeric_limits<double>::infinity(), seconds};
  for (auto& [sensor, track] : tracks_) {
    for (InputObservation& observation : track.held) {
      move(observation, seconds);
      step.stamp = std::min(step.stamp, observation.stamp);
    }
    release(track);
  }
  offset_ += seconds;
  registry_.addClockStep(robot_, step);
}

}  // namespace lamp
