#include <algorithm>
#include <cmath>

#include "Worlds.h"

namespace lamp::simulation {

namespace {

using Eigen::Vector3d;

constexpr double kColumnM = 14.0, kDepthM = 22.0, kFloorM = 5.0, kStairM = 11.0;
constexpr double kStairwellM = 5.0;  ///< from the last column to the stairs

const WallStyle kWall{0.015, 0.0, 0.3, 0.0, Material::kConcrete};
const PassageStyle kCorridor{2.6, 2.8, 0.05, kWall};
const PassageStyle kDoorway{1.9, 2.3, 0.05, kWall};

/** A kind of room; rooms of one kind look alike, down to what stands in them. */
struct RoomKind {
  Vector3d size;
  int clutter;
};
const RoomKind kRooms[] = {{{7, 6, 2.8}, 7}, {{9, 7, 3.2}, 12}, {{6, 5.5, 2.6}, 5}};

/** One floor: two long corridors, cross-corridors, halls between, rooms outside. */
class Storey {
 public:
  Storey(const Vector3d& origin, int columns, uint64_t room_seed, WorldBuilder& builder)
      : origin_(origin), columns_(columns), room_seed_(room_seed), builder_(builder) {
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < columns; ++column)
        places_[row].push_back(builder.addPlace(at(column * kColumnM, row * kDepthM)));
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column + 1 < columns; ++column) addCorridor(row, column);
    for (int column = 0; column < columns; column += 2) {
      const size_t across = builder.addPassage(places_[0][static_cast<size_t>(column)],
                                               places_[1][static_cast<size_t>(column)], kCorridor);
      if (chance(builder.random(), 0.5)) builder.addDoorFrame(across, 0.3, 1.8, 2.1);
    }
    for (int column = 1; column < columns; column += 2) addHall(column);
  }

  size_t corner(int row, bool last) const {
    return last ? places_[row].back() : places_[row].front();
  }
  Vector3d at(double x, double y) const { return origin_ + Vector3d(x, y, 0); }

 private:
  void addCorridor(int row, int column) {
    const size_t from = places_[row][static_cast<size_t>(column)],
                 to = places_[row][static_cast<size_t>(column) + 1];
    const size_t corridor = builder_.addPassage(from, to, kCorridor);
    if (chance(builder_.random(), 0.6)) builder_.addPipe(corridor, 2.45, 0.07, row == 0 ? 1 : -1);
    addRoom(row, column);
  }

  /** A dead end: the doorway leaves the corridor at the column's place. */
  void addRoom(int row, int column) {
    const auto kind = pick(builder_.random(), std::size(kRooms));
    const RoomKind& room = kRooms[kind];
    const double out = row == 0 ? -1.0 : 1.0;
    const Vector3d middle =
        at(column * kColumnM, row * kDepthM) + Vector3d(0, out * (2.2 + 0.5 * room.size.y()), 0);
    builder_.addRoom(middle, room.size, 0, kWall);
    const size_t inside = builder_.addPlace(middle);
    const size_t door =
        builder_.addPassage(places_[row][static_cast<size_t>(column)], inside, kDoorway);
    builder_.addDoorFrame(door, 1.8 / builder_.layout().passages[door].length(), 1.3, 2.05);
    Random clutter(mixSeeds({room_seed_, kind}));
    builder_.addClutter(middle, 0.42 * room.size.y(), room.clutter, clutter);
    rooms_[kind].push_back(middle);
    if (rooms_[kind].size() == 2) builder_.addLookAlikes(rooms_[kind]);
  }

  /** An open area between the corridors, with columns; it can be crossed. */
  void addHall(int column) {
    const Vector3d middle = at(column * kColumnM, 0.5 * kDepthM);
    const Vector3d size(10.5, 15.0, 4.2);
    builder_.addRoom(middle, size, 0, kWall);
    builder_.addPassage(places_[0][static_cast<size_t>(column)],
                        places_[1][static_cast<size_t>(column)], kDoorway);
    for (const double x : {-3.0, 3.0})
      for (const double y : {-4.0, 4.0})
        builder_.addPillar({middle + Vector3d(x, y, -0.5), 0.3, size.z() + 1.0, true});
    builder_.addClutter(middle, 5.0, 14, builder_.random());
  }

  Vector3d origin_;
  int columns_;
  uint64_t room_seed_;
  WorldBuilder& builder_;
  std::vector<size_t> places_[2];
  std::vector<Vector3d> rooms_[std::size(kRooms)];
};

/** A stair from the lower floor's `row` to the upper floor's other row, beyond the end at `x`. */
void addStair(const Storey& lower, const Storey& upper, int row, bool last, double x,
              WorldBuilder& builder) {
  const double direction = row == 0 ? 1.0 : -1.0;
  const auto y = [&](double way) { return row * kDepthM + direction * way; };
  const Vector3d bottom = lower.at(x, y(4.0)), top = upper.at(x, y(4.0 + kStairM));
  const size_t foot = builder.addPlace(bottom), head = builder.addPlace(top);
  builder.addPassage(lower.corner(row, last), foot, kCorridor, {lower.at(x, y(0))});
  builder.addPassage(foot, head, {2.4, 2.9, 0.05, kWall});
  builder.addPassage(head, upper.corner(1 - row, last), kCorridor, {upper.at(x, y(kDepthM))});

  const int steps = static_cast<int>(std::round((top - bottom).z() / 0.17));
  const Vector3d step = (top - bottom) / steps;
  const double run = std::abs(step.y());
  for (int i = 0; i < steps; ++i) {
    Pose3 pose = Pose3::Identity();
    pose.translation() = bottom + (i + 0.5) * step - Vector3d(0, 0, 0.5 * step.z() + 0.2);
    builder.addSolid(box(pose, {2.4, run, step.z() + 0.2}, Material::kConcrete));
  }
}

}  // namespace

void addBuilding(double ways_m, size_t gate, double lead_m, WorldBuilder& builder) {
  const double column_m = 2 * kColumnM + kDepthM + 8;  // corridors, a way across, and doorways
  const int columns = std::max(3, static_cast<int>(std::ceil(ways_m / column_m)) + 1);
  const Vector3d origin = builder.layout().places[gate] + Vector3d(lead_m, 0, 0);
  const auto room_seed = builder.random()();
  const Storey ground(origin, columns, room_seed, builder);
  const Storey upper(origin + Vector3d(0, 0, kFloorM), columns, room_seed, builder);
  builder.addPassage(gate, ground.corner(0, false), {4.0, 3.0, 0.05, kWall});
  addStair(ground, upper, 0, true, (columns - 1) * kColumnM + kStairwellM, builder);
  addStair(ground, upper, 1, false, -kStairwellM, builder);
}

}  // namespace lamp::simulation
