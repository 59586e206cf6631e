#pragma once

#include "lamp/core/Stage.h"
#include "lamp/registration/InitialAligner.h"
#include "lamp/scans/Icp.h"

namespace lamp {

/** A refined relative pose and what is known of it. */
struct RegistrationResult {
  Pose3 target_T_source = Pose3::Identity();
  /** Tangent space at target_T_source; in the plane only x, y and yaw are meaningful. */
  Matrix6d covariance = Matrix6d::Identity();
  bool converged = false;
  int iterations = 0;
};

/** Second stage of the loop closure computation (paper II-C). */
class Refiner : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(Refiner)

 public:
  virtual RegistrationResult refine(const PreparedScan& source, const PreparedScan& target,
                                    const Hypothesis& hypothesis) const = 0;
};

/** Covariance of a registration from the information matrix A = Σ HᵀH of point-to-plane ICP. */
struct RegistrationCovarianceOptions {
  double sigma_m = 0.05;
  double correlated_points = 20;
  double floor_sigma_m = 0.05;
  double floor_sigma_deg = 0.5;
  double max_sigma_m = 1.0;

  void visit(OptionVisitor& v);
};

/** `σ² A⁻¹`, with neighbouring points counted as one measurement, plus a floor for what the model
 * leaves out. Directions that the scans do not observe get `max_sigma` (metres, and radians at one
 * metre), not less. \param information A in metres. */
Matrix6d registrationCovariance(const Matrix6d& information,
                                const RegistrationCovarianceOptions& options, bool planar);

struct RefinerOptions {
  IcpOptions icp;
  RegistrationCovarianceOptions covariance;

  void visit(OptionVisitor& v);
};

/** Generalised ICP. */
class Gicp : public Refiner {
  DEFINE_MRPT_OBJECT(Gicp, lamp)

 public:
  RefinerOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  RegistrationResult refine(const PreparedScan& source, const PreparedScan& target,
                            const Hypothesis& hypothesis) const override;
};

/** Point-to-plane ICP; in the plane, point to line. */
class PointToPlane : public Refiner {
  DEFINE_MRPT_OBJECT(PointToPlane, lamp)

 public:
  RefinerOptions options;
  void visit(OptionVisitor& v) override { options.visit(v); }
  RegistrationResult refine(const PreparedScan& source, const PreparedScan& target,
                            const Hypothesis& hypothesis) const override;
};

}  // namespace lamp
