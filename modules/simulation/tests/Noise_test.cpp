#include "lamp/simulation/Noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lamp::simulation {
namespace {

constexpr double kWavelength = 1.7;

/** Points on both sides of zero, many wavelengths wide. */
std::vector<Eigen::Vector3d> points(size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-60, 60);
  std::vector<Eigen::Vector3d> all;
  for (size_t i = 0; i < count; ++i)
    all.emplace_back(uniform(random), uniform(random), uniform(random));
  return all;
}

TEST(Noise, TheSeedDecidesTheField) {
  const Noise one(1), same(1), other(2);
  int equal = 0;
  for (const Eigen::Vector3d& p : points(500)) {
    EXPECT_EQ(one.at(p, kWavelength), same.at(p, kWavelength));
    equal += one.at(p, kWavelength) == other.at(p, kWavelength);
  }
  EXPECT_LT(equal, 25) << "another seed gives another field";
}

TEST(Noise, VanishesAtLatticePointsAndStaysWithinOne) {
  const Noise noise(3);
  for (int i = -3; i <= 3; ++i)
    EXPECT_NEAR(noise.at(kWavelength * Eigen::Vector3d(i, 2 * i, -i), kWavelength), 0, 1e-9);
  double largest = 0;
  for (const Eigen::Vector3d& p : points(20000))
    largest = std::max(largest, std::abs(noise.at(p, kWavelength)));
  EXPECT_LE(largest, 1.0);
  EXPECT_GE(largest, 0.5) << "it is no flat field";
}

TEST(Noise, HasMeanZero) {
  const Noise noise(4);
  double sum = 0, fractal = 0;
  for (const Eigen::Vector3d& p : points(20000)) {
    sum += noise.at(p, kWavelength);
    fractal += noise.fractal(p, kWavelength, 3);
  }
  // The standard deviation of the means is about 0.002 and 0.0025.
  EXPECT_NEAR(sum / 20000, 0, 0.012);
  EXPECT_NEAR(fractal / 20000, 0, 0.015);
}

TEST(Noise, IsContinuousAlsoAcrossLatticePlanes) {
  const Noise noise(5);
  constexpr double kStep = 1e-6;
  for (Eigen::Vector3d p : points(3000))
    for (int axis = 0; axis < 3; ++axis) {
      const double there = p[axis];
      for (const double at : {there, std::round(there / kWavelength) * kWavelength}) {
        Eigen::Vector3d before = p, after = p;
        before[axis] = at - kStep;
        after[axis] = at + kStep;
        const double slope =
            (noise.at(after, kWavelength) - noise.at(before, kWavelength)) / (2 * kStep);
        EXPECT_LT(std::abs(slope), 4.0 / kWavelength);
      }
    }
}

/** Mean product of the field at two points `distance` apart, over its mean square. */
double correlation(const Noise& noise, double distance) {
  double product = 0, square = 0;
  for (const Eigen::Vector3d& p : points(20000)) {
    const double here = noise.at(p, kWavelength);
    product += here * noise.at(p + Eigen::Vector3d(distance, 0, 0), kWavelength);
    square += here * here;
  }
  return product / square;
}

TEST(Noise, ItsFeaturesAreAWavelengthWide) {
  const Noise noise(6);
  EXPECT_GT(correlation(noise, 0.1 * kWavelength), 0.9);
  EXPECT_NEAR(correlation(noise, 3 * kWavelength), 0, 0.05);
}

TEST(Noise, EachOctaveAddsHalfTheHeightAtHalfTheWavelength) {
  const Noise noise(7);
  double first = 0, second = 0;
  for (const Eigen::Vector3d& p : points(20000)) {
    EXPECT_EQ(noise.fractal(p, kWavelength, 1), noise.at(p, kWavelength));
    first += std::pow(noise.fractal(p, kWavelength, 1), 2);
    second += std::pow(noise.fractal(p, kWavelength, 2) - noise.fractal(p, kWavelength, 1), 2);
  }
  EXPECT_NEAR(second / first, 0.25, 0.02);
}

}  // namespace
}  // namespace lamp::simulation
