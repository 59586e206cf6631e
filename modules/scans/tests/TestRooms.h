#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

namespace lamp {

/** Points on the floor, the walls and two boxes of a room of 10 x 8 x 3 m around the origin. */
inline std::vector<Eigen::Vector3f> roomPoints(size_t count, float noise_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> noise(0.0f, noise_m > 0 ? noise_m : 1e-9f);
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < count; ++i) {
    const float u = unit(random), v = unit(random);
    Eigen::Vector3f p;
    switch (i % 6) {
      case 0:
        p = {10 * u - 5, 8 * v - 4, 0};
        break;
      case 1:
        p = {10 * u - 5, -4, 3 * v};
        break;
      case 2:
        p = {10 * u - 5, 4, 3 * v};
        break;
      case 3:
        p = {-5, 8 * u - 4, 3 * v};
        break;
      case 4:
        p = {5, 8 * u - 4, 3 * v};
        break;
      default:
        p = {2 + u, 1, 1.5f * v};
    }
    points.push_back(p + Eigen::Vector3f(noise(random), noise(random), noise(random)));
  }
  return points;
}

/** Returns of a level 2D laser in an L-shaped room, dense along the walls, z = 0. */
inline std::vector<Eigen::Vector3f> planarRoomPoints(size_t count, float noise_m, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::normal_distribution<float> noise(0.0f, noise_m);
  const std::vector<Eigen::Vector2f> corners = {{-4, -3}, {4, -3}, {4, 1}, {1, 1}, {1, 3}, {-4, 3}};
  std::vector<Eigen::Vector3f> points;
  for (size_t i = 0; i < count; ++i) {
    const Eigen::Vector2f a = corners[i % 6], b = corners[(i + 1) % 6];
    const Eigen::Vector2f p =
        a + unit(random) * (b - a) + Eigen::Vector2f(noise(random), noise(random));
    points.emplace_back(p.x(), p.y(), 0.0f);
  }
  return points;
}

}  // namespace lamp
