#include "rejection/PoseVolume.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "lamp/core/ChiSquare.h"
#include "solver/Information.h"

namespace lamp {

namespace {

/** Volumes of the unit balls in three and six dimensions. */
constexpr double kBall3 = 4.0 / 3.0 * M_PI, kBall6 = M_PI * M_PI * M_PI / 6.0;
/** Volume of all rotations, in units of rotation vectors near the identity. */
constexpr double kAllRotations = 8.0 * M_PI * M_PI;

/** Share of true loops that lie in their ellipsoids. */
constexpr double kUsual = 0.99;

/** An ellipsoid that extends beyond the box is cut off softly, at this multiple of the box's
 * covariance. */
constexpr double kCut = 3.0;

template <class Matrix>
double determinant(const Matrix& positive) {
  return std::pow(Matrix(positive.llt().matrixL()).diagonal().prod(), 2);
}

/** Ratio of two ellipsoids' volumes, from their covariances. \param D of the box. */
template <class Matrix>
double share(const Matrix& C, const Matrix& D) {
  const Matrix cut = Matrix::Identity() + C * (kCut * D).inverse();
  return std::min(1.0,
                  std::sqrt(determinant<Matrix>(C) / (determinant<Matrix>(D) * cut.determinant())));
}

}  // namespace

PoseVolume::PoseVolume(const PoseGraph& graph, const OdometryChains& chains)
    : planar_(graph.planar()), usual_(chiSquareQuantile(kUsual, planar_ ? 3 : 6)) {
  Eigen::AlignedBox3d box;
  for (const Node& node : graph.nodes()) box.extend(chains.poseFromFirst(node.id).translation());
  setExtent(box.sizes());
}

PoseVolume::PoseVolume(const PoseGraph& graph)
    : planar_(graph.planar()), usual_(chiSquareQuantile(kUsual, planar_ ? 3 : 6)) {
  Eigen::AlignedBox3d box;
  for (const Node& node : graph.nodes()) box.extend(node.world_T_base.translation());
  setExtent(box.sizes());
}

void PoseVolume::setExtent(const Eigen::Vector3d& extent) {
  for (int axis = 0; axis < 3; ++axis) sides_[axis] = 2.0 * std::max(1.0, extent[axis]);
  sides_.tail<3>().setConstant(planar_ ? 2.0 * M_PI : std::cbrt(kAllRotations));
}

double PoseVolume::chance(const Matrix6d& covariance, double threshold) const {
  const double radius2 = threshold * (planar_ ? std::cbrt(kBall3 * kBall3) : std::cbrt(kBall6));
  const Matrix6d D = (sides_.cwiseAbs2() / radius2).asDiagonal();
  if (planar_) return share<Eigen::Matrix3d>(planarBlock(covariance), planarBlock(D));
  return share<Matrix6d>(covariance, D);
}

}  // namespace lamp
