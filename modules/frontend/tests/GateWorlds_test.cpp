/** Robots before the gates of simulated worlds, each at its start pose, with signs along the walls
 * that reflect as the plates do. LAMP_GATE_SEEDS sets how many seeds of each kind of world are
 * tried. */
#include <gtest/gtest.h>
#include <mrpt/obs/CObservationVelodyneScan.h>

#include <cstdlib>
#include <iostream>
#include <sstream>

#include "lamp/frontend/GateCalibration.h"
#include "lamp/input/ScanFromObservation.h"
#include "lamp/simulation/Route.h"
#include "lamp/simulation/SimConfig.h"
#include "lamp/simulation/VelodyneObservation.h"

namespace lamp {
namespace {

using namespace simulation;

constexpr double kBegin = 1.6e9, kStanding_s = 3, kDegree = M_PI / 180.0;

/** A world, and where its robots wait. */
struct Site {
  Site(const std::string& name, uint64_t seed)
      : config(worldKind(name), Ini(), Faults()),
        world(config.kind->make(200, config.cellM(), mixSeeds({seed, 1}))),
        caster(world.mesh) {
    const std::vector<double> lengths(config.robots.size(), 30.0);
    const auto routes = planRoutes(world.layout, lengths, mixSeeds({seed, 2}));
    for (size_t i = 0; i < routes.size(); ++i)
      starts.push_back(
          drive(routes[i], caster, config.robots[i].drive, kBegin, mixSeeds({seed, 3, i}))
              .front()
              .pose);
  }

  GateOptions gate() const {
    GateOptions options;
    for (const Eigen::Vector3d& plate : world.plates)
      options.plates.insert(options.plates.end(), plate.data(), plate.data() + 3);
    return options;
  }

  SimConfig config;
  World world;
  RayCaster caster;
  std::vector<Pose3> starts;
};

GateCalibration standing(const Site& site, size_t robot, const GateOptions& gate, uint64_t seed) {
  const TrajectoryInterpolator truth(
      {{kBegin, site.starts[robot]}, {kBegin + kStanding_s + 1, site.starts[robot]}});
  GateCalibration calibration(gate);
  for (const std::string& name : site.config.robots[robot].lidars) {
    const Lidar lidar(site.config.lidars.at(name), site.caster);
    for (int i = 0; i < 10 * kStanding_s; ++i)
      for (const auto& observation :
           velodyneObservations(lidar.sweep(truth, kBegin + 0.1 * i, mixSeeds({seed, robot})),
                                lidar, "robot/" + name))
        calibration.add(*scanFromObservation(*observation, name, {}));
  }
  for (const ImuReading& reading : simulateImu(truth, site.config.imu, mixSeeds({seed, robot, 7})))
    if (reading.stamp < kBegin + kStanding_s) calibration.addForce(reading.specific_force);
  return calibration;
}

/** Directions to the plates from a robot's first lidar, degrees to the left and up. */
std::string directions(const Site& site, size_t robot) {
  const Lidar lidar(site.config.lidars.at(site.config.robots[robot].lidars.front()), site.caster);
  const Pose3 world_T_lidar = site.starts[robot] * lidar.baseTSensor(kBegin);
  std::ostringstream text;
  for (const Eigen::Vector3d& plate : site.world.plates) {
    const Eigen::Vector3d p = world_T_lidar.inverse() * plate;
    const bool visible =
        site.caster.visible(world_T_lidar.translation().cast<float>(), plate.cast<float>());
    text << " (" << std::atan2(p.y(), p.x()) / kDegree << ", "
         << std::atan2(p.z(), p.head<2>().norm()) / kDegree << (visible ? ")" : ", hidden)");
  }
  return text.str();
}

int seeds() {
  const char* const text = std::getenv("LAMP_GATE_SEEDS");
  return text ? std::atoi(text) : 1;
}

class GateWorlds : public testing::TestWithParam<const char*> {};

TEST_P(GateWorlds, RobotsFindWhereTheyStand) {
  const std::string kind = GetParam();
  if (!std::getenv("LAMP_GATE_SEEDS") && kind != "demo" && kind != "finals")
    GTEST_SKIP() << "takes long; set LAMP_GATE_SEEDS";
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(seeds()); ++seed) {
    const Site site(kind, seed);
    for (size_t robot = 0; robot < site.starts.size(); ++robot) {
      const GateResult result = standing(site, robot, site.gate(), seed).solve();
      if (!result.pose) {
        ADD_FAILURE() << seed << " " << site.config.robots[robot].name << ": " << result.reason
                      << "; the plates lie at" << directions(site, robot);
        continue;
      }
      const Vector6d error = logSE3(site.starts[robot].inverse() * result.pose->world_T_base);
      const double chi_square = error.dot(result.pose->covariance.inverse() * error);
      std::cout << kind << " " << seed << " " << site.config.robots[robot].name << ": "
                << 1000 * error.head<3>().transpose() << " mm, "
                << error.tail<3>().transpose() / kDegree << " deg; sigmas "
                << 1000 * result.pose->covariance.diagonal().head<3>().cwiseSqrt().transpose()
                << " mm "
                << result.pose->covariance.diagonal().tail<3>().cwiseSqrt().transpose() / kDegree
                << " deg, chi-square " << chi_square << std::endl;
      EXPECT_LT(error.head<2>().norm(), 0.03) << site.config.robots[robot].name;
      // Beams lie 0.14 m apart on the plates, and accelerometers have biases of 0.1 degrees.
      EXPECT_LT(std::abs(error.z()), 0.07);
      EXPECT_LT(std::abs(error[5]), 0.1 * kDegree);
      EXPECT_LT(error.segment<2>(3).norm(), 0.5 * kDegree);
      EXPECT_LT(chi_square, 30);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, GateWorlds,
                         testing::Values("tunnel", "urban", "finals", "ku", "demo"));

}  // namespace
}  // namespace lamp
