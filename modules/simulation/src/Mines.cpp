#include <algorithm>
#include <cmath>

#include "Worlds.h"

namespace lamp {

namespace {

using Eigen::Vector3d;

/** A mine of parallel entries joined by cross-cuts, with pillars of rock between them. */
struct GridMine {
  int columns, rows;  ///< junctions along and across
  double spacing_m;
  double jitter_m;      ///< of the junctions
  double missing;       ///< share of the drives that were never driven
  double stub;          ///< share of junctions with a dead end
  double narrow, wide;  ///< factors of the drives' width
};

/** Grows until the drives are `drives_m` long together. */
GridMine sized(GridMine mine, double drives_m) {
  const auto length = [&] {
    return ((mine.columns - 1) * mine.rows + mine.columns * (mine.rows - 1)) * mine.spacing_m *
           (1.0 - mine.missing);
  };
  while (length() < drives_m) ++(mine.columns < 3 * mine.rows ? mine.columns : mine.rows);
  return mine;
}

/** Joins the gate's place to a grid of drives; the grid begins `lead_m` in front of it. */
std::vector<size_t> addGrid(const GridMine& mine, const PassageStyle& style, size_t gate,
                            double lead_m, WorldBuilder& builder) {
  Random& random = builder.random();
  const Vector3d origin =
      builder.layout().places[gate] + Vector3d(lead_m, -mine.spacing_m * (mine.rows / 2), 0);
  std::vector<size_t> junctions;
  for (int column = 0; column < mine.columns; ++column)
    for (int row = 0; row < mine.rows; ++row) {
      const Vector3d jitter(uniform(random, -mine.jitter_m, mine.jitter_m),
                            uniform(random, -mine.jitter_m, mine.jitter_m), 0);
      const bool first = column == 0 && row == mine.rows / 2;
      junctions.push_back(builder.addPlace(origin + mine.spacing_m * Vector3d(column, row, 0) +
                                           (first ? Vector3d(Vector3d::Zero()) : jitter)));
    }
  const auto at = [&](int column, int row) {
    return junctions[static_cast<size_t>(column * mine.rows + row)];
  };
  const auto drive = [&](size_t a, size_t b) {
    PassageStyle own = style;
    own.width_m *= uniform(random, mine.narrow, mine.wide);
    return builder.addPassage(a, b, own);
  };
  std::vector<size_t> passages = {drive(gate, at(0, mine.rows / 2))};
  for (int column = 0; column < mine.columns; ++column)
    for (int row = 0; row < mine.rows; ++row) {
      // The first entry and the first cross-cut always exist, so that all is joined.
      const bool spine = row == mine.rows / 2;
      if (column + 1 < mine.columns && (spine || !chance(random, mine.missing)))
        passages.push_back(drive(at(column, row), at(column + 1, row)));
      if (row + 1 < mine.rows && (column % 3 == 0 || !chance(random, mine.missing)))
        passages.push_back(drive(at(column, row), at(column, row + 1)));
      if ((row == 0 || row + 1 == mine.rows) && chance(random, mine.stub)) {
        const double out = row == 0 ? -1.0 : 1.0;
        const Vector3d end = builder.layout().places[at(column, row)] +
                             Vector3d(0, out * mine.spacing_m * uniform(random, 0.4, 0.7), 0);
        passages.push_back(drive(at(column, row), builder.addPlace(end)));
      }
    }
  std::vector<Vector3d> alike;
  for (const size_t junction : junctions) alike.push_back(builder.layout().places[junction]);
  builder.addLookAlikes(std::move(alike));
  return passages;
}

}  // namespace

void addCoalMine(double drives_m, size_t gate, double lead_m, WorldBuilder& builder) {
  const GridMine mine = sized({2, 3, 28.0, 0.8, 0.25, 0.35, 0.95, 1.05}, drives_m);
  const PassageStyle style{5.0, 2.6, 0.4, {0.07, 0.06, 0.5, 0.6, Material::kRock}};
  for (const size_t passage : addGrid(mine, style, gate, lead_m, builder)) {
    if (chance(builder.random(), 0.2)) builder.addSupports(passage, 5.0);
    if (chance(builder.random(), 0.3)) builder.addPipe(passage, 1.9, 0.08, 1);
    builder.addRubble(passage, 9.0, 0.3);
  }
}

void addLimestoneMine(double drives_m, size_t gate, double lead_m, WorldBuilder& builder) {
  const GridMine mine = sized({3, 3, 38.0, 2.5, 0.12, 0.25, 0.72, 1.35}, drives_m);
  const PassageStyle style{14.0, 7.5, 1.0, {0.35, 0.5, 0.12, 2.0, Material::kRock}};
  for (const size_t passage : addGrid(mine, style, gate, lead_m, builder)) {
    builder.addRubble(passage, 5.0, 0.9);
    if (!chance(builder.random(), 0.15)) continue;
    const Passage& way = builder.layout().passages[passage];
    builder.addClutter(0.5 * (way.floor.front() + way.floor.back()), 6.0, 8, builder.random());
  }
}

}  // namespace lamp
