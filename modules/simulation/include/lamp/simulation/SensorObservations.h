#pragma once

#include <memory>
#include <string>
#include <vector>

#include "lamp/simulation/Artifacts.h"
#include "lamp/simulation/Imu.h"
#include "lamp/simulation/OdometryModel.h"
#include "lamp/simulation/Radio.h"

namespace mrpt::obs {
class CObservationBearingRange;
class CObservationIMU;
class CObservationRobotPose;
class CObservationWirelessPower;
}  // namespace mrpt::obs

namespace lamp::simulation {

/** `robot/odom`: odom_T_base and its accumulated covariance. \param index of the pose. */
std::shared_ptr<mrpt::obs::CObservationRobotPose> odometryObservation(
    const SimulatedOdometry& odometry, size_t index, const std::string& robot);

/** `robot/imu`: IMU_X_ACC to IMU_Z_ACC (m/s²) and IMU_WX to IMU_WZ (rad/s), base frame. */
std::shared_ptr<mrpt::obs::CObservationIMU> imuObservation(const ImuReading& reading,
                                                           const std::string& robot);

/** `robot/beacon_NAME`. MRPT's `power` goes from 0 to 100: it is 100 - path loss in dB, clamped.
 * \param antenna_m height above the base. */
std::shared_ptr<mrpt::obs::CObservationWirelessPower> rssiObservation(const RssiReading& reading,
                                                                      const Beacon& beacon,
                                                                      const std::string& robot,
                                                                      double antenna_m);

/** `robot/artifact`: what is seen at one stamp is one observation, with an artifact's id as
 * landmarkID. \param sightings by stamp. */
std::vector<std::shared_ptr<mrpt::obs::CObservationBearingRange>> artifactObservations(
    const std::vector<Sighting>& sightings, const ArtifactOptions& options,
    const std::string& robot);

}  // namespace lamp::simulation
