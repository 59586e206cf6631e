#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lamp/base_station/BaseStation.h"
#include "lamp/slam_app/SlamConfig.h"

namespace lamp::test {

constexpr RobotId kA{0}, kB{1};

/** The config that an ini text gives. */
inline SlamConfig configFrom(const std::string& text) {
  registerAllClasses_lamp();
  Faults faults;
  Ini ini = Ini::fromText(text, "test.ini", faults);
  return SlamConfig(std::move(ini), std::move(faults));
}

/** A level hall of 24 x 16 m with boxes in it, each of its own size; seen all around, through
 * everything, up to 9 m. */
class Hall {
 public:
  Hall() {
    box(0, 0, 24, 16);
    box(7, 6.5, 10, 9);
    box(13, 7, 17.5, 9.5);
    for (const auto& [x, y, size] : {std::tuple{1.0, 1.0, 0.7},
                                     {6.0, 0.8, 1.2},
                                     {12.0, 1.2, 0.5},
                                     {18.0, 0.5, 1.5},
                                     {22.0, 6.0, 1.0},
                                     {21.5, 13.0, 0.8},
                                     {15.0, 13.5, 1.3},
                                     {9.0, 14.0, 0.6},
                                     {2.0, 13.0, 1.4},
                                     {1.0, 7.0, 0.9}})
      box(x, y, x + size, y + 0.7 * size);
  }

  KeyedScanPtr scan(const Pose3& world_T_base, unsigned seed, bool planar) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::normal_distribution<double> noise(0, 0.01);
    auto scan = std::make_shared<Scan>();
    const auto add = [&](const Eigen::Vector3d& p) {
      const Eigen::Vector3d seen = world_T_base.inverse() * p;
      if (seen.head<2>().norm() < 9) scan->points.push_back(seen.cast<float>());
    };
    for (const auto& [a, b] : walls_)
      for (double s = 0.15 * unit(random); s < (b - a).norm(); s += 0.15) {
        const Eigen::Vector2d p =
            a + s * (b - a).normalized() + Eigen::Vector2d(noise(random), noise(random));
        add({p.x(), p.y(), planar ? 0 : 2.5 * unit(random)});
      }
    for (int i = 0; i < (planar ? 0 : 600); ++i)
      add({24 * unit(random), 16 * unit(random), noise(random) - 0.3});
    scan->sensor.assign(scan->points.size(), 0);
    scan->sensors.push_back({"lidar", Eigen::Vector3d::Zero()});
    return scan;
  }

 private:
  void box(double x0, double y0, double x1, double y1) {
    const Eigen::Vector2d corners[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    for (int i = 0; i < 4; ++i) walls_.emplace_back(corners[i], corners[(i + 1) % 4]);
  }
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls_;
};

/** What one robot sends, and where it truly was. */
struct RobotDrive {
  std::vector<KeyNodePacket> packets;
  RobotEnd end;
  std::vector<StampedPose> truth;      ///< of the key nodes
  std::vector<StampedPose> all_scans;  ///< truth at every scan
};

struct DriveOptions {
  RobotId robot = kA;
  std::vector<Eigen::Vector2d> route;
  unsigned seed = 1;
  bool planar = true;
  bool start_pose = true;
  Pose3 start_error = Pose3::Identity();
  double start_sigma_m = 1e-3, start_sigma_rad = 1e-3;
};

/** A drive with a scan every 0.5 m, a key node every 2 m, and odometry that is 1 % too long and
 * turns aside by 0.003 rad/m, beside noise. */
inline RobotDrive drive(const DriveOptions& options) {
  static const Hall hall;
  std::mt19937 random(options.seed);
  std::normal_distribution<double> noise;
  RobotDrive result;
  Pose3 odom_T_base = Pose3::Identity(), previous_truth = Pose3::Identity();
  std::vector<StampedPose> passed;
  double stamp = 1000 + 0.1 * options.robot.value;
  size_t scans = 0;
  for (size_t leg = 0; leg + 1 < options.route.size(); ++leg) {
    const Eigen::Vector2d way = options.route[leg + 1] - options.route[leg];
    const double yaw = std::atan2(way.y(), way.x());
    for (double s = 0; s < way.norm() - 1e-6; s += 0.5, stamp += 0.5, ++scans) {
      const Eigen::Vector2d p = options.route[leg] + s * way.normalized();
      const Pose3 truth = planarPose(p.x(), p.y(), yaw);
      if (scans > 0) {
        const Pose3 motion = previous_truth.inverse() * truth;
        Pose3 measured = motion;
        measured.translation() *= 1.01;
        odom_T_base = odom_T_base * measured *
                      planarPose(0.002 * noise(random), 0.002 * noise(random),
                                 0.003 * motion.translation().norm() + 5e-4 * noise(random));
      }
      previous_truth = truth;
      result.all_scans.push_back({stamp, truth});
      if (scans % 4 != 0) {
        passed.push_back({stamp, odom_T_base});
        continue;
      }
      KeyNodePacket packet;
      packet.id = {options.robot, static_cast<uint32_t>(result.packets.size())};
      packet.stamp = stamp;
      packet.odom_T_base = odom_T_base;
      packet.planar = options.planar;
      packet.scan = hall.scan(truth, options.seed * 1000 + packet.id.index, options.planar);
      packet.passed_scans = std::move(passed);
      passed.clear();
      if (!result.packets.empty()) {
        Vector6d sigmas;
        sigmas << 0.05, 0.05, 0.05, 0.01, 0.01, 0.01;
        packet.odometry = OdometryEdge{result.packets.back().odom_T_base.inverse() * odom_T_base,
                                       Matrix6d(sigmas.cwiseAbs2().asDiagonal())};
      } else if (options.start_pose) {
        Vector6d sigmas;
        sigmas.head<3>().setConstant(options.start_sigma_m);
        sigmas.tail<3>().setConstant(options.start_sigma_rad);
        packet.prior =
            StartPrior{truth * options.start_error, Matrix6d(sigmas.cwiseAbs2().asDiagonal())};
      }
      result.packets.push_back(packet);
      result.truth.push_back({stamp, truth});
    }
  }
  result.end = {options.robot, passed, {}};
  return result;
}

/** Two robots that drive around the hall in opposite directions, each a bit more than one round.
 * The first one knows where it starts, the second one to about half a metre. */
struct Team {
  explicit Team(bool planar = true, bool start_poses = true) {
    DriveOptions a;
    a.route = {{4, 4}, {20, 4}, {20, 12}, {4, 12}, {4, 4}, {11, 4}};
    a.planar = planar;
    a.start_pose = start_poses;
    DriveOptions b;
    b.robot = kB;
    b.seed = 2;
    b.route = {{20, 11}, {20, 4}, {4, 4}, {4, 12}, {20, 12}, {20, 7}};
    b.planar = planar;
    b.start_pose = start_poses;
    b.start_error = planarPose(0.4, -0.3, 0.04);
    b.start_sigma_m = 0.5;
    b.start_sigma_rad = 0.09;
    drives = {drive(a), drive(b)};
  }

  /** Hands all packets to the base station as they would come, and finishes. */
  void sendTo(BaseStation& base) const {
    send(base);
    const std::atomic<bool> interrupted{false};
    base.finish(interrupted);
  }

  void send(BaseStation& base) const {
    std::vector<const KeyNodePacket*> packets;
    for (const RobotDrive& of_robot : drives)
      for (const KeyNodePacket& packet : of_robot.packets) packets.push_back(&packet);
    std::stable_sort(packets.begin(), packets.end(),
                     [](const auto* a, const auto* b) { return a->stamp < b->stamp; });
    for (const KeyNodePacket* packet : packets) base.receive(*packet);
    for (const RobotDrive& of_robot : drives) base.receive(of_robot.end);
  }

  std::vector<RobotDrive> drives;
};

/** Root of the mean squared distance of poses with equal stamps, metres. */
inline double rmse(const std::vector<StampedPose>& truth, const std::vector<StampedPose>& poses) {
  EXPECT_EQ(truth.size(), poses.size());
  double squares = 0;
  for (size_t i = 0; i < std::min(truth.size(), poses.size()); ++i) {
    EXPECT_EQ(truth[i].stamp, poses[i].stamp);
    squares += (truth[i].pose.translation() - poses[i].pose.translation()).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(truth.size()));
}

/** A base station with its timer. */
struct Station {
  explicit Station(const std::string& ini) : Station(configFrom(ini)) {}
  Station(SlamConfig c, BaseStationSetup setup)
      : config(std::move(c)), base(std::move(setup), timer) {
    timer.setMinLoggingLevel(mrpt::system::LVL_ERROR);
  }

  SlamConfig config;
  mrpt::system::CTimeLogger timer;
  BaseStation base;

 private:
  explicit Station(const SlamConfig& c) : Station(c, c.makeBaseStationSetup()) {}
};

/** Small searches, so that tests are quick. */
inline std::string teamIni(const std::string& pipeline = "", const std::string& base_station = "") {
  return "[pipeline]\ncandidates = FixedRadius\nexporters =\n" + pipeline + "\n[base_station]\n" +
         base_station +
         "\n[lamp::FixedRadius]\nradius_m = 6\nbetween_robots_radius_m = 6\nmax_per_robot = 2\n";
}

}  // namespace lamp::test
