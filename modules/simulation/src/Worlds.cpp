#include "Worlds.h"

#include <algorithm>
#include <stdexcept>

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

World finish(WorldBuilder& builder, double length_m, double cell_m) {
  builder.addGate();
  builder.addDistractors(std::max(2, static_cast<int>(length_m / 150)));
  builder.addArtifacts(std::max(4, static_cast<int>(length_m / 150)));
  return builder.build(cell_m);
}

}  // namespace

World makeTunnel(double length_m, double cell_m, uint64_t seed) {
  WorldBuilder builder(seed);
  const size_t gate = builder.addPlace(Vector3d::Zero());
  addCoalMine(0.55 * length_m, gate, 25.0, builder);
  return finish(builder, length_m, cell_m);
}

World makeUrban(double length_m, double cell_m, uint64_t seed) {
  WorldBuilder builder(seed);
  const size_t gate = builder.addPlace(Vector3d::Zero());
  addBuilding(0.3 * length_m, gate, 16.0, builder);
  return finish(builder, length_m, cell_m);
}

World makeFinals(double length_m, double cell_m, uint64_t seed) {
  WorldBuilder builder(seed);
  const WallStyle concrete{0.015, 0.0, 0.3, 0.0, Material::kConcrete};
  const PassageStyle link{4.0, 3.2, 0.1, concrete};
  const size_t gate = builder.addPlace(Vector3d::Zero());
  const size_t hall = builder.addPlace({18, 0, 0});
  builder.addPassage(gate, hall, link);
  builder.addRoom({18, 0, 0}, {13, 12, 5.5}, 0, concrete);
  const size_t cave = builder.addPlace({18, 45, 0}), mine = builder.addPlace({18, -75, 0});
  builder.addPassage(hall, cave, link);
  builder.addPassage(hall, mine, {4.5, 2.8, 0.4, {0.07, 0.06, 0.5, 0.6, Material::kRock}});
  addBuilding(0.13 * length_m, hall, 20.0, builder);
  addCave(0.16 * length_m, cave, 10.0, builder);
  addCoalMine(0.2 * length_m, mine, 15.0, builder);
  return finish(builder, length_m, cell_m);
}

World makeKu(double length_m, double cell_m, uint64_t seed) {
  WorldBuilder builder(seed);
  const size_t gate = builder.addPlace(Vector3d::Zero());
  addLimestoneMine(0.5 * length_m, gate, 30.0, builder);
  return finish(builder, length_m, cell_m);
}

World makeDemo(double length_m, double cell_m, uint64_t seed) {
  WorldBuilder builder(seed);
  const double scale = std::clamp(length_m / 150, 0.7, 4.0);
  const auto place = [&](double x, double y) {
    const bool gate = x == 0;
    const Vector3d jitter(uniform(builder.random(), -1.5, 1.5),
                          uniform(builder.random(), -1.5, 1.5), 0);
    return builder.addPlace(scale * (Vector3d(x, y, 0) + (gate ? Vector3d(0, 0, 0) : jitter)));
  };
  const PassageStyle drive{3.4, 2.7, 0.4, {0.15, 0.15, 0.3, 0.8, Material::kRock}};
  const size_t gate = place(0, 0), a = place(11, 0), b = place(24, 1), c = place(23, 13),
               d = place(10, 14), end = place(32, 8);
  for (const auto& [from, to] :
       std::vector<std::pair<size_t, size_t>>{{gate, a}, {a, b}, {b, c}, {c, d}, {d, a}, {b, end}})
    builder.addRubble(builder.addPassage(from, to, drive), 4.0, 0.35);
  builder.addRoom(builder.layout().places[end], {8, 7, 3.5}, 0.3,
                  {0.015, 0.0, 0.3, 0.0, Material::kConcrete});
  builder.addClutter(builder.layout().places[end], 3.0, 8, builder.random());
  builder.addRoom(builder.layout().places[d], {8, 9, 4.5}, 0.8,
                  {0.4, 0.4, 0.2, 0.8, Material::kRock});
  builder.addPipe(1, 1.9, 0.08, 1);
  return finish(builder, length_m, cell_m);
}

const std::vector<WorldKind>& worldKinds() {
  // Ways, lidars and ATE of LAMP 1.0 in the paper's experiments (III, Fig. on ATE).
  static const std::vector<std::string> kHusky = {"top", "front", "rear"}, kSpot = {"top"},
                                        kHovermap = {"hovermap"};
  static const std::vector<WorldKind> kKinds = {
      {"tunnel",
       "coal mine: long, narrow, nearly featureless drives with cross-cuts",
       {{"husky3", 1194, kHusky, 1.07}, {"husky4", 1362, kHusky, 1.44}},
       0.2,
       makeTunnel},
      {"urban",
       "power plant: two floors, halls, small rooms, passages, stairs",
       {{"husky1", 612, kHusky, 0.95}, {"husky4", 416, kHusky, 0.78}, {"spot1", 502, kSpot, 0.99}},
       0.15,
       makeUrban},
      {"finals",
       "tunnel, cave and urban parts joined",
       {{"husky3", 72, kHusky, 0.56},
        {"spot1", 430, kSpot, 0.37},
        {"spot3", 484, kHovermap, 0.55},
        {"spot4", 238, kSpot, 0.62}},
       0.2,
       makeFinals},
      {"ku",
       "limestone mine: rooms and pillars, drives 10 to 20 m wide",
       {{"husky1", 2204, kHusky, 5.34},
        {"husky2", 1526, kHusky, 2.85},
        {"husky3", 1678, kHovermap, 2.11},
        {"husky4", 896, kHusky, 5.49}},
       0.25,
       makeKu},
      {"demo",
       "a small mine for a first look",
       {{"alpha", 80, kSpot, 0.3}, {"bravo", 70, kSpot, 0.3}},
       0.15,
       makeDemo}};
  return kKinds;
}

const WorldKind& worldKind(const std::string& name) {
  std::string known;
  for (const WorldKind& kind : worldKinds()) {
    if (kind.name == name) return kind;
    known += (known.empty() ? "" : ", ") + kind.name;
  }
  throw std::runtime_error("there is no world '" + name + "'; known: " + known);
}

}  // namespace lamp::simulation
