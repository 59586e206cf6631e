#include "lamp/base_station/OperatorActions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TemporaryFolder.h"
#include "lamp/base_station/OperatorState.h"
#include "lamp/core/Files.h"

namespace lamp {
namespace {

using testing::HasSubstr;

std::vector<OperatorAction> actionsFrom(const std::string& text) {
  const std::string path = test::freshFolder() + "/actions.csv";
  writeTextFile(path, text);
  return readActions(path);
}

std::string faultOf(const std::string& text) {
  try {
    actionsFrom(text);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(OperatorActions, ReadBackAsWritten) {
  const std::string text =
      "key_nodes,action,loop_id,robot,from,to,x,y,z,qx,qy,qz,qw,sigma_m,sigma_deg\n"
      "30,add,,,A:3,B:7,1.25,-2,0.1,0,0,0.6000001,0.8,0.05,1\n"
      "4,veto,17,,,,,,,,,,,,\n"
      "4,pin,,,A:1,B:2,,,,,,,,,\n"
      "9,ignore,,B,,,,,,,,,,,\n";
  const std::vector<OperatorAction> actions = actionsFrom(text);
  ASSERT_EQ(actions.size(), 4u);
  EXPECT_EQ(actions[0].kind, ActionKind::kVeto) << "by key nodes";
  EXPECT_EQ(actions[0].loop_id, 17u);
  EXPECT_EQ(actions[1].from, "A:1");
  EXPECT_EQ(actions[2].robot, "B");
  EXPECT_EQ(actions[3].position.y(), -2);
  EXPECT_EQ(actions[3].rotation.z(), 0.6000001);
  EXPECT_EQ(actions[3].sigma_deg, 1);

  std::vector<ActionRecord> records;
  for (const OperatorAction& action : actions) records.push_back({action, "done"});
  const std::string written = toCsv(records).text();
  std::vector<ActionRecord> again;
  for (const OperatorAction& action : actionsFrom(written)) again.push_back({action, "done"});
  EXPECT_EQ(toCsv(again).text(), written);
}

TEST(OperatorActions, ColumnsThatNoActionNeedsMayBeAbsent) {
  EXPECT_EQ(actionsFrom("action,key_nodes\nfreeze,3\nreset,5\n").size(), 2u);
  EXPECT_TRUE(actionsFrom("key_nodes,action\n").empty());
}

TEST(OperatorActions, FaultsNameTheLine) {
  const std::string header = "key_nodes,action,loop_id,robot,from,to,x,y,z,qx,qy,qz,qw,sigma_m\n";
  EXPECT_THAT(faultOf("stamp,action\n"), HasSubstr("actions.csv:1: the header must name"));
  EXPECT_THAT(faultOf("key_nodes,action\n1,freeze\n-1,freeze\n"),
              HasSubstr("actions.csv:3: key_nodes '-1' is not a count"));
  EXPECT_THAT(faultOf("key_nodes,action\nx,freeze\n"), HasSubstr("is not a finite number"));
  EXPECT_THAT(faultOf("key_nodes,action\n1,melt\n"), HasSubstr("there is no action 'melt'; known"));
  EXPECT_THAT(faultOf("key_nodes,action\n1,veto\n"), HasSubstr("needs a loop_id, or from and to"));
  EXPECT_THAT(faultOf("key_nodes,action,from,to\n1,pin,A:1,\n"), HasSubstr("needs a to"));
  EXPECT_THAT(faultOf("key_nodes,action\n1,ignore\n"), HasSubstr("needs a robot"));
  EXPECT_THAT(faultOf(header + "1,add,,,A:1,A:2,0,0,0,0,0,0,2,1\n"), HasSubstr("unit quaternion"));
  EXPECT_THAT(faultOf(header + "1,add,,,A:1,A:2,0,0,0,0,0,0,1,0\n"), HasSubstr("must be above 0"));
  EXPECT_THAT(faultOf(header + "1,add,,,A:1,A:2,0,0,0,0,0,0,1,1\n"),
              HasSubstr("needs a sigma_deg"));
  EXPECT_THAT(faultOf(header + "1,add,,,A:1,A:2,nan,0,0,0,0,0,1,1\n"),
              HasSubstr("x 'nan' is not a finite number"));
}

TEST(OperatorState, AnIgnoredRobotsLoopsWithOthersStayOut) {
  RobotTable robots;
  const RobotId a = robots.add("A"), b = robots.add("B");
  PoseGraph graph;
  for (const RobotId robot : {a, b})
    for (uint32_t i : {0u, 1u}) {
      Node node;
      node.id = {robot, i};
      graph.addNode(node);
    }
  Edge edge;
  edge.type = EdgeType::kLoopClosure;
  edge.from = {a, 0};
  edge.to = {b, 0};
  graph.addEdge(edge);
  edge.from = {b, 1};
  graph.addEdge(edge);

  OperatorState state;
  Ledger ledger;
  OperatorAction action;
  action.robot = "B";
  action.kind = ActionKind::kIgnore;
  EXPECT_EQ(state.apply(action, 0, robots, graph, ledger), "done");
  EXPECT_EQ(state.admitted(graph), (std::vector<bool>{false, true}));
  EXPECT_FALSE(state.maySearch({a, 1}, {b, 1}));
  EXPECT_TRUE(state.maySearch({b, 0}, {b, 1}));
  action.kind = ActionKind::kRevive;
  EXPECT_EQ(state.apply(action, 0, robots, graph, ledger), "done");
  EXPECT_EQ(state.admitted(graph), (std::vector<bool>{true, true}));
}

}  // namespace
}  // namespace lamp
