#include <algorithm>
#include <cmath>

#include "Worlds.h"

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

const WallStyle kCaveWall{0.55, 1.0, 0.12, 2.5, Material::kRock};

PassageStyle passageStyle(Random& random) {
  const double width = uniform(random, 4.4, 6.5), height = uniform(random, 3.0, 5.0);
  return {width, height, 0.42 * std::min(width, height), kCaveWall};
}

}  // namespace

void addCave(double ways_m, size_t gate, double lead_m, WorldBuilder& builder) {
  Random& random = builder.random();
  constexpr double kStepM = 11.0;
  const double ring_m = std::max(6 * kStepM, 0.75 * ways_m);
  const int count = static_cast<int>(ring_m / kStepM);
  const double radius = ring_m / (2 * M_PI);
  const Vector3d start = builder.layout().places[gate];
  const Vector3d middle = start + Vector3d(0, lead_m + radius, 0);

  std::vector<size_t> ring;
  for (int i = 0; i < count; ++i) {
    const double angle = -M_PI / 2 + 2 * M_PI * i / count;
    const double r = radius * (i == 0 ? 1.0 : uniform(random, 0.78, 1.2));
    const double z = i == 0 ? 0.0 : uniform(random, -1.2, 1.2);
    ring.push_back(
        builder.addPlace(middle + Vector3d(r * std::cos(angle), r * std::sin(angle), z)));
  }
  std::vector<size_t> passages = {builder.addPassage(gate, ring[0], passageStyle(random))};
  for (size_t i = 0; i < ring.size(); ++i) {
    passages.push_back(
        builder.addPassage(ring[i], ring[(i + 1) % ring.size()], passageStyle(random)));
    const Vector3d here = builder.layout().places[ring[i]];
    const Vector3d out = (here - middle).normalized();
    if (i % 3 == 1) {
      const Vector3d end = here + Vector3d(out.x(), out.y(), 0) * uniform(random, 8, 13);
      passages.push_back(builder.addPassage(ring[i], builder.addPlace(end), passageStyle(random)));
    }
    // Every bend opens into a chamber, or robots that cut the corner would hit rock.
    if (i % 4 == 2)
      builder.addRoom(here, {uniform(random, 9, 14), uniform(random, 8, 12), uniform(random, 5, 7)},
                      uniform(random, 0, M_PI), kCaveWall);
    else
      builder.addRoom(here, {7.5, 7.5, 4.2}, uniform(random, 0, M_PI), kCaveWall);
  }
  if (count >= 8)
    passages.push_back(builder.addPassage(ring[2], ring[ring.size() - 2], passageStyle(random)));
  for (const size_t passage : passages) builder.addRubble(passage, 3.0, 0.6);
}

}  // namespace lamp::simulation
