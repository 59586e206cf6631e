#include <algorithm>
#include <cmath>

#include "Worlds.h"

namespace lamp::simulation {

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

/** The drives of a mine, before they are dug. */
struct Drive {
  size_t from, to;
  double width_m;
};

/** Places that drives join to `start`. */
std::vector<bool> reachable(const std::vector<Drive>& drives, size_t start, size_t places) {
  std::vector<bool> reached(places, false);
  reached[start] = true;
  for (bool grown = true; grown;) {
    grown = false;
    for (const Drive& drive : drives) {
      if (reached[drive.from] == reached[drive.to]) continue;
      reached[drive.from] = reached[drive.to] = grown = true;
    }
  }
  return reached;
}

/** Joins the gate's place to a grid of drives; the grid begins `lead_m` in front of it. */
class Grid {
 public:
  Grid(const GridMine& mine, const PassageStyle& style, size_t gate, double lead_m,
       WorldBuilder& builder)
      : mine_(mine), style_(style), builder_(builder), random_(builder.random()) {
    addJunctions(builder.layout().places[gate] +
                 Vector3d(lead_m, -mine.spacing_m * (mine.rows / 2), 0));
    plan(gate, at(0, mine.rows / 2));
    for (int column = 0; column < mine.columns; ++column)
      for (int row = 0; row < mine.rows; ++row) planAt(column, row);
    // Small mines might have none otherwise.
    if (!has_stub_) planStub(0, mine.rows - 1);
    reached_ = reachable(drives_, gate, builder.layout().places.size());
  }

  /** Digs the drives. What cannot be reached from the gate is left as rock. */
  std::vector<size_t> dig() {
    std::vector<size_t> passages;
    for (const Drive& drive : drives_) {
      if (!reached_[drive.from]) continue;
      PassageStyle own = style_;
      own.width_m = drive.width_m;
      passages.push_back(builder_.addPassage(drive.from, drive.to, own));
    }
    std::vector<Vector3d> alike;
    for (const size_t junction : junctions_)
      if (reached_[junction]) alike.push_back(builder_.layout().places[junction]);
    builder_.addLookAlikes(std::move(alike));
    return passages;
  }

 private:
  size_t at(int column, int row) const {
    return junctions_[static_cast<size_t>(column * mine_.rows + row)];
  }

  void addJunctions(const Vector3d& origin) {
    for (int column = 0; column < mine_.columns; ++column)
      for (int row = 0; row < mine_.rows; ++row) {
        const Vector3d jitter(uniform(random_, -mine_.jitter_m, mine_.jitter_m),
                              uniform(random_, -mine_.jitter_m, mine_.jitter_m), 0);
        const bool first = column == 0 && row == mine_.rows / 2;
        junctions_.push_back(builder_.addPlace(origin + mine_.spacing_m * Vector3d(column, row, 0) +
                                               (first ? Vector3d(Vector3d::Zero()) : jitter)));
      }
  }

  void plan(size_t from, size_t to) {
    drives_.push_back({from, to, style_.width_m * uniform(random_, mine_.narrow, mine_.wide)});
  }

  /** Drives that leave a junction upwards in column and row, and a dead end outwards. */
  void planAt(int column, int row) {
    // The first entry, every third cross-cut, and one round of a pillar always exist.
    const bool spine = row == mine_.rows / 2, below_spine = row + 1 == mine_.rows / 2;
    if (column + 1 < mine_.columns &&
        (spine || !chance(random_, mine_.missing) || (below_spine && column == 0)))
      plan(at(column, row), at(column + 1, row));
    if (row + 1 < mine_.rows &&
        (column % 3 == 0 || !chance(random_, mine_.missing) || (below_spine && column == 1)))
      plan(at(column, row), at(column, row + 1));
    if ((row == 0 || row + 1 == mine_.rows) && chance(random_, mine_.stub)) planStub(column, row);
  }

  void planStub(int column, int row) {
    const double out = row == 0 ? -1.0 : 1.0;
    const Vector3d end = builder_.layout().places[at(column, row)] +
                         Vector3d(0, out * mine_.spacing_m * uniform(random_, 0.4, 0.7), 0);
    plan(at(column, row), builder_.addPlace(end));
    has_stub_ = true;
  }

  const GridMine mine_;
  const PassageStyle style_;
  WorldBuilder& builder_;
  Random& random_;
  std::vector<size_t> junctions_;
  std::vector<Drive> drives_;
  std::vector<bool> reached_;
  bool has_stub_ = false;
};

}  // namespace

void addCoalMine(double drives_m, size_t gate, double lead_m, WorldBuilder& builder) {
  const GridMine mine = sized({2, 3, 28.0, 0.8, 0.25, 0.35, 0.95, 1.05}, drives_m);
  const PassageStyle style{5.0, 2.6, 0.4, {0.07, 0.06, 0.5, 0.6, Material::kRock}};
  for (const size_t passage : Grid(mine, style, gate, lead_m, builder).dig()) {
    if (chance(builder.random(), 0.2)) builder.addSupports(passage, 5.0);
    if (chance(builder.random(), 0.3)) builder.addPipe(passage, 1.9, 0.08, 1);
    builder.addRubble(passage, 9.0, 0.3);
  }
}

void addLimestoneMine(double drives_m, size_t gate, double lead_m, WorldBuilder& builder) {
  const GridMine mine = sized({3, 3, 38.0, 2.5, 0.12, 0.25, 0.72, 1.35}, drives_m);
  const PassageStyle style{14.0, 7.5, 1.0, {0.35, 0.5, 0.12, 2.0, Material::kRock}};
  for (const size_t passage : Grid(mine, style, gate, lead_m, builder).dig()) {
    builder.addRubble(passage, 5.0, 0.9);
    if (!chance(builder.random(), 0.15)) continue;
    const Passage& way = builder.layout().passages[passage];
    builder.addClutter(0.5 * (way.floor.front() + way.floor.back()), 6.0, 8, builder.random());
  }
}

}  // namespace lamp::simulation
