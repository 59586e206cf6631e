#pragma once

#include <string>
#include <vector>

#include "lamp/core/Stage.h"
#include "lamp/registration/InitialAligner.h"
#include "lamp/scans/RegistrationInformation.h"
#include "lamp/scans/Icp.h"

namespace lamp {

/** A refined relative pose and what is known of it. */
struct RegistrationResult {
  Pose3 target_T_source = Pose3::Identity();
  Pose3 start = Pose3::Identity();  ///< the hypothesis that it was refined from
  /** Tangent space at target_T_source. None in directions that the scans do not observe; in the
   * plane only x, y and yaw count. */
  Matrix6d information = Matrix6d::Zero();
  std::vector<std::string> unobserved;  ///< those directions, in words
  bool converged = false;
  int iterations = 0;
  std::vector<Score> scores;  ///< further figures for the ledger
};

/** Second stage of the loop closure computation (paper II-C). */
class Refiner : public Stage {
  DEFINE_VIRTUAL_MRPT_OBJECT(Refiner)

 public:
  virtual RegistrationResult refine(const PreparedScan& source, const PreparedScan& target,
                                    const Hypothesis& hypothesis) const = 0;
};

struct RefinerOptions {
  IcpOptions icp;
  RegistrationInformationOptions information;

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
