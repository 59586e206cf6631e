#include "lamp/scans/Observability.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lamp {
namespace {

using Eigen::Vector3d;

/** Surface points with normals, about their centroid. */
class Surface {
 public:
  void add(const Vector3d& p, const Vector3d& n) {
    Vector6d h;
    h << n, p.cross(n);
    information_ += h * h.transpose();
    squares_ += p.squaredNorm();
    ++points_;
  }
  Observability observed() const {
    return observability(information_, points_, std::sqrt(squares_ / points_));
  }

 private:
  Matrix6d information_ = Matrix6d::Zero();
  double squares_ = 0, points_ = 0;
};

template <class Use>
void forSquare(const Use& use) {
  for (int i = -10; i <= 10; ++i)
    for (int j = -10; j <= 10; ++j) use(0.1 * i, 0.1 * j);
}

TEST(Observability, OfAPlane) {
  Surface plane;
  forSquare([&](double x, double y) { plane.add({x, y, 0}, Vector3d::UnitZ()); });
  const Observability seen = plane.observed();
  EXPECT_LT((seen.translation - Vector3d(0, 0, 1)).norm(), 1e-9);
  // Half the squared distance from the centre lies in x, half in y.
  EXPECT_LT((seen.rotation - Vector3d(0, 0.5, 0.5)).norm(), 1e-9);
  EXPECT_NEAR(std::abs(seen.translations.col(2).z()), 1, 1e-9);
  EXPECT_NEAR(std::abs(seen.rotations.col(0).z()), 1, 1e-9);
}

TEST(Observability, OfASphereIsThatOfTranslationAlone) {
  Surface sphere;
  for (int i = 0; i < 3; ++i)  // corners of an octahedron: the same second moments as a sphere's
    for (const double side : {-2.0, 2.0})
      sphere.add(side * Vector3d::Unit(i), Vector3d::Unit(i) * (side / 2));
  const Observability seen = sphere.observed();
  EXPECT_LT((seen.translation - Vector3d::Constant(1.0 / 3)).norm(), 1e-9);
  EXPECT_LT(seen.rotation.norm(), 1e-9);
}

TEST(Observability, OfARoundTunnelLacksItsAxisTwice) {
  Surface tunnel;
  for (int x = -20; x <= 20; ++x)
    for (int a = 0; a < 36; ++a) {
      const double angle = a * M_PI / 18;
      const Vector3d n(0, std::cos(angle), std::sin(angle));
      tunnel.add(Vector3d(0.5 * x, 0, 0) + 2 * n, n);
    }
  const Observability seen = tunnel.observed();
  EXPECT_LT((seen.translation - Vector3d(0, 0.5, 0.5)).norm(), 1e-9);
  EXPECT_NEAR(std::abs(seen.translations.col(0).x()), 1, 1e-9);
  EXPECT_NEAR(seen.rotation[0], 0, 1e-9);
  EXPECT_NEAR(std::abs(seen.rotations.col(0).x()), 1, 1e-9);
  const double along = 0.25 * 140;  // mean square of x: (20 · 21 / 3) / 4
  EXPECT_NEAR(seen.rotation[1], 0.5 * along / (along + 4), 1e-9);
}

TEST(Observability, OfACubicRoomIsAThirdEachWay) {
  Surface room;
  forSquare([&](double u, double v) {
    for (const double side : {-1.0, 1.0}) {
      room.add({side, u, v}, Vector3d::UnitX());
      room.add({u, side, v}, Vector3d::UnitY());
      room.add({u, v, side}, Vector3d::UnitZ());
    }
  });
  const Observability seen = room.observed();
  EXPECT_LT((seen.translation - Vector3d::Constant(1.0 / 3)).norm(), 1e-9);
  EXPECT_GT(seen.rotation[0], 0.1);
  EXPECT_NEAR(seen.rotation[0], seen.rotation[2], 1e-9);
}

TEST(Observability, AMotionThatAnotherOneMakesUpForIsNotObserved) {
  // Two points with the same normal, both on one side: moving along it can be undone by turning.
  Surface edge;
  for (const double x : {1.0, 1.0}) edge.add({x, 0, 0}, Vector3d::UnitZ());
  EXPECT_LT(edge.observed().translation.norm(), 1e-9);
}

TEST(Observability, OfNothingIsZero) {
  EXPECT_EQ(observability(Matrix6d::Zero(), 0, 0).translation.norm(), 0);
  EXPECT_EQ(observability(Matrix6d::Zero(), 10, 1).rotation.norm(), 0);
}

}  // namespace
}  // namespace lamp
