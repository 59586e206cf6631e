#include "lamp/base_station/OperatorActions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace lamp {

namespace {

constexpr std::array<std::pair<const char*, ActionKind>, 10> kNames = {{
    {"remove", ActionKind::kRemove},
    {"veto", ActionKind::kVeto},
    {"pin", ActionKind::kPin},
    {"restore", ActionKind::kRestore},
    {"add", ActionKind::kAdd},
    {"ignore", ActionKind::kIgnore},
    {"revive", ActionKind::kRevive},
    {"freeze", ActionKind::kFreeze},
    {"unfreeze", ActionKind::kUnfreeze},
    {"reset", ActionKind::kReset},
}};

const char* toString(ActionKind kind) {
  for (const auto& [name, of_name] : kNames)
    if (of_name == kind) return name;
  return "";
}

/** One row; columns that the file does not have are empty. */
class ActionRow {
 public:
  ActionRow(const CsvTable& table, size_t row, std::string where)
      : table_(table), cells_(table.rows[row]), where_(std::move(where)) {}

  OperatorAction action() const {
    OperatorAction action;
    action.where = where_;
    action.key_nodes = count("key_nodes");
    action.kind = kind();
    switch (action.kind) {
      case ActionKind::kRemove:
      case ActionKind::kVeto:
      case ActionKind::kPin:
      case ActionKind::kRestore:
        readLoop(action);
        break;
      case ActionKind::kAdd:
        readMeasurement(action);
        break;
      case ActionKind::kIgnore:
      case ActionKind::kRevive:
        action.robot = required("robot");
        break;
      default:
        break;
    }
    return action;
  }

 private:
  std::string cell(const std::string& column) const {
    return table_.has(column) ? cells_[table_.column(column)] : "";
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(where_ + ": " + what);
  }

  std::string required(const std::string& column) const {
    const std::string text = cell(column);
    if (text.empty()) fail("the action '" + cell("action") + "' needs a " + column);
    return text;
  }

  double number(const std::string& column) const {
    double value = 0;
    if (!parseDouble(required(column), value) || !std::isfinite(value))
      fail(column + " '" + cell(column) + "' is not a finite number");
    return value;
  }

  size_t count(const std::string& column) const {
    const double value = number(column);
    if (value < 0 || value != std::floor(value) || value > 1e15)
      fail(column + " '" + cell(column) + "' is not a count");
    return static_cast<size_t>(value);
  }

  double positive(const std::string& column) const {
    const double value = number(column);
    if (!(value > 0)) fail(column + " '" + cell(column) + "' must be above 0");
    return value;
  }

  ActionKind kind() const {
    std::string known;
    for (const auto& [name, kind] : kNames) {
      if (cell("action") == name) return kind;
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    fail("there is no action '" + cell("action") + "'; known are " + known);
  }

  void readLoop(OperatorAction& action) const {
    if (!cell("loop_id").empty()) {
      action.loop_id = count("loop_id");
    } else {
      if (cell("from").empty() && cell("to").empty())
        fail("the action '" + cell("action") + "' needs a loop_id, or from and to");
      action.from = required("from");
      action.to = required("to");
    }
  }

  void readMeasurement(OperatorAction& action) const {
    action.from = required("from");
    action.to = required("to");
    const Eigen::Quaterniond q(number("qw"), number("qx"), number("qy"), number("qz"));
    constexpr double kMaxDeviation = 1e-3;
    if (std::abs(q.norm() - 1) > kMaxDeviation) fail("qx qy qz qw is not a unit quaternion");
    action.rotation = q;
    action.position << number("x"), number("y"), number("z");
    action.sigma_m = positive("sigma_m");
    action.sigma_deg = positive("sigma_deg");
  }

  const CsvTable& table_;
  const std::vector<std::string>& cells_;
  const std::string where_;
};

}  // namespace

std::vector<OperatorAction> readActions(const std::string& path) {
  const CsvTable table = CsvTable::fromFile(path);
  if (!table.has("key_nodes") || !table.has("action"))
    throw std::runtime_error(path + ":1: the header must name the columns key_nodes and action");
  std::vector<OperatorAction> actions;
  for (size_t row = 0; row < table.rows.size(); ++row)
    actions.push_back(ActionRow(table, row, path + ":" + std::to_string(row + 2)).action());
  std::stable_sort(
      actions.begin(), actions.end(),
      [](const OperatorAction& a, const OperatorAction& b) { return a.key_nodes < b.key_nodes; });
  return actions;
}

CsvTable toCsv(const std::vector<ActionRecord>& records) {
  CsvTable table{{"key_nodes", "action", "loop_id", "robot", "from", "to", "x", "y", "z", "qx",
                  "qy", "qz", "qw", "sigma_m", "sigma_deg", "outcome"},
                 {}};
  for (const auto& [action, outcome] : records) {
    std::vector<std::string> row = {std::to_string(action.key_nodes),
                                    toString(action.kind),
                                    action.loop_id ? std::to_string(*action.loop_id) : "",
                                    action.robot,
                                    action.from,
                                    action.to};
    const Eigen::Quaterniond& q = action.rotation;
    const Eigen::Vector3d& t = action.position;
    for (const double value :
         {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w(), action.sigma_m, action.sigma_deg})
      row.push_back(action.kind == ActionKind::kAdd ? formatDouble(value) : "");
    row.push_back(outcome);
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace lamp
