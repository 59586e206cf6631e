#include "Reflectance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lamp::simulation {
namespace {

constexpr float kRockAlbedo = 0.25f, kConcreteAlbedo = 0.32f, kMetalAlbedo = 0.12f;
constexpr float kReflectorAlbedo = 20.0f;  // sends the light back where it came from
constexpr float kDiffuseMax = 100.0f / 255.0f;
constexpr float kRockTexture_m = 1.5f;

/** Even in [0, 1) for each corner of a lattice. */
float cornerNoise(int32_t x, int32_t y, int32_t z) {
  uint32_t h = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u ^
               static_cast<uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return static_cast<float>((h ^ (h >> 15)) >> 8) * 0x1p-24f;
}

/** Value noise: corners of a lattice of 1 m, linear between. */
float valueNoise(const Eigen::Vector3f& p) {
  const Eigen::Vector3f floor = p.array().floor();
  const Eigen::Vector3f f = p - floor;
  const Eigen::Vector3i c = floor.cast<int>();
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = corner >> 1 & 1, dz = corner >> 2;
    const float weight =
        (dx ? f.x() : 1 - f.x()) * (dy ? f.y() : 1 - f.y()) * (dz ? f.z() : 1 - f.z());
    sum += weight * cornerNoise(c.x() + dx, c.y() + dy, c.z() + dz);
  }
  return sum;
}

}  // namespace

float albedoOf(Material material, const Eigen::Vector3f& point) {
  switch (material) {
    case Material::kRock:
      return kRockAlbedo * (0.6f + 0.8f * valueNoise(point / kRockTexture_m));
    case Material::kConcrete:
      return kConcreteAlbedo;
    case Material::kMetal:
      return kMetalAlbedo;
    case Material::kReflector:
      return kReflectorAlbedo;
  }
  return kRockAlbedo;
}

float intensityOf(const LitSurface& surface) {
  const float c = surface.cos_incidence;
  if (surface.material == Material::kReflector)
    return std::clamp(0.72f + 0.25f * c - 0.001f * surface.range_m, 0.65f, 1.0f);
  float intensity = surface.albedo * (0.3f + 0.7f * c);
  // Metal flashes where it mirrors the beam back.
  if (surface.material == Material::kMetal) intensity += 0.25f * std::pow(c, 40.0f);
  intensity *= 1.0f - std::min(0.3f, 0.004f * surface.range_m);
  return std::min(intensity, kDiffuseMax);
}

float returnProbability(const LitSurface& surface, float cos_grazing, float max_range_m) {
  const float far = surface.range_m / max_range_m;
  const float growth = (1.0f / cos_grazing - 1.0f) * far * far * kRockAlbedo / surface.albedo;
  const float ratio = surface.cos_incidence / (cos_grazing * (1.0f + growth));
  return std::min(1.0f, ratio * ratio);
}

}  // namespace lamp::simulation
