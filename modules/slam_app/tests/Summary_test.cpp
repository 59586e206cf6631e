#include "Summary.h"

#include <gtest/gtest.h>

#include "TestTeam.h"

namespace lamp {
namespace {

using namespace test;

/** The summary of a run of two robots, and what it was made of. */
struct TeamSummary {
  explicit TeamSummary(const std::string& pipeline = "") : station(teamIni(pipeline)) {
    robots.add("husky");
    robots.add("spot", 's');
    team.sendTo(station.base);
    FrontEnd::Counts counts;
    counts.scans = 123;
    counts.empty_scans = 4;
    counts.without_odometry = 5;
    const RunResult result{station.config, robots, station.base, {{kB, counts, {"a warning"}}},
                           {"damaged"},    false};
    json = summarize(result);
  }

  Team team;
  Station station;
  RobotTable robots;
  nlohmann::ordered_json json;
};

TEST(Summary, CountsAddUp) {
  const TeamSummary summary;
  const auto& json = summary.json;
  const auto& loops = json["loops"];
  EXPECT_GT(loops["inliers"], 0);
  EXPECT_LE(loops["inliers"], loops["verified"]);
  EXPECT_LE(loops["verified"], loops["attempts"]);
  EXPECT_LE(loops["attempts"], loops["candidates"]);
  EXPECT_EQ(loops["attempts"], summary.station.base.ledger().rows().size());

  size_t of_robots = 0, of_components = 0, inliers = 0;
  for (const auto& robot : json["robots"]) of_robots += robot["key_nodes"].get<size_t>();
  for (const auto& component : json["components"]) {
    of_components += component["key_nodes"].get<size_t>();
    inliers += component["inliers_within_robots"].get<size_t>() +
               component["inliers_between_robots"].get<size_t>();
  }
  EXPECT_EQ(json["key_nodes"], of_robots);
  EXPECT_EQ(json["key_nodes"], of_components);
  EXPECT_EQ(json["key_nodes"],
            summary.team.drives[0].packets.size() + summary.team.drives[1].packets.size());
  EXPECT_EQ(loops["inliers"], inliers);

  size_t inlier_rows = 0;
  const CsvTable ledger =
      summary.station.base.ledger().loops(summary.station.base.graph(), summary.robots);
  for (const auto& row : ledger.rows)
    inlier_rows += row[ledger.column("verdict")] == "inlier" ? 1 : 0;
  EXPECT_EQ(loops["inliers"], inlier_rows);
}

TEST(Summary, TellsOfRobotsAndComponents) {
  const TeamSummary summary;
  const auto& json = summary.json;
  EXPECT_EQ(json["seed"], 1);
  EXPECT_EQ(json["planar"], true);
  EXPECT_EQ(json["interrupted"], false);
  EXPECT_EQ(json["warnings"][0], "damaged");
  ASSERT_EQ(json["robots"].size(), 2u);
  EXPECT_EQ(json["robots"][0]["name"], "husky");
  EXPECT_EQ(json["robots"][0]["key"], "a");
  const auto& spot = json["robots"][1];
  EXPECT_EQ(spot["key"], "s");
  EXPECT_EQ(spot["scans"], 123);
  EXPECT_EQ(spot["empty_scans"], 4);
  EXPECT_EQ(spot["scans_without_odometry"], 5);
  EXPECT_EQ(spot["start_pose_known"], true);
  EXPECT_EQ(spot["warnings"][0], "a warning");
  // 52 m of way from the first to the last scan; odometry makes it 1 % longer.
  const double way = 7 + 16 + 8 + 16 + 5 - 0.5;
  EXPECT_NEAR(spot["optimized_length_m"], way, 0.02 * way);
  EXPECT_NEAR(spot["odometry_length_m"], 1.01 * way, 0.01 * way);

  ASSERT_EQ(json["components"].size(), 1u);
  EXPECT_EQ(json["components"][0]["map"], "maps/map");
  EXPECT_EQ(json["components"][0]["anchor"], "husky:0");
  EXPECT_EQ(json["components"][0]["robots"].size(), 2u);
  EXPECT_GT(json["components"][0]["inliers_between_robots"], 0);
  EXPECT_GT(json["optimization"]["optimizations"], 0);
  EXPECT_EQ(json["optimization"]["usable"], true);
}

TEST(Summary, SeparateRobotsHaveAComponentEach) {
  const TeamSummary summary("inter_robot_loops = false\n");
  const auto& components = summary.json["components"];
  ASSERT_EQ(components.size(), 2u);
  EXPECT_GE(components[0]["key_nodes"], components[1]["key_nodes"]);
  EXPECT_EQ(components[1]["map"], "maps/map_2");
  for (const auto& component : components) EXPECT_EQ(component["inliers_between_robots"], 0);
}

}  // namespace
}  // namespace lamp
