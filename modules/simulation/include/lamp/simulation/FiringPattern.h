#pragma once

#include <Eigen/Core>

namespace lamp::simulation {

/** When and where the 16 lasers of a spinning lidar fire: the pattern of a VLP-16, as MRPT's
 * decoder of its packets sees it.
 *
 * A revolution is a row of firing sequences; in each the lasers fire one after the other in the
 * order of their ids. One or two sequences make a block of a packet. The head turns evenly and
 * clockwise seen from above, so azimuth is time. Sensor frame: x forward at azimuth 0, z up.
 */
class FiringPattern {
 public:
  static constexpr int kLasers = 16;

  /** \param sequences a revolution; \param rate_hz revolutions per second;
   *  \param sequences_per_block 1 or 2. */
  FiringPattern(int sequences, double rate_hz, int sequences_per_block);

  int sequences() const { return sequences_; }
  int sequencesPerBlock() const { return sequences_per_block_; }
  double duration() const { return 1.0 / rate_hz_; }
  /** Seconds since the begin of the revolution. */
  double delay(int sequence, int laser) const { return sequence * sequence_s_ + laser * laser_s_; }
  /** Radians, clockwise seen from above. */
  double azimuth(int sequence, int laser) const;
  /** Unit vector in the sensor frame. */
  Eigen::Vector3f direction(int sequence, int laser) const;
  /** Radians above the sensor's x-y plane. */
  static double elevation(int laser);

 private:
  int sequences_;
  int sequences_per_block_;
  double rate_hz_;
  double sequence_s_;
  double laser_s_;
};

}  // namespace lamp::simulation
