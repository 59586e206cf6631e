#include "lamp/core/Csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp {

namespace {

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

void appendRow(const std::vector<std::string>& cells, std::string& text) {
  for (size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : ",") + quoted(cells[i]);
  text += "\n";
}

/** Takes one row off the text, across quoted line breaks. */
std::vector<std::string> takeRow(const std::string& text, size_t& at) {
  std::vector<std::string> cells(1);
  bool in_quotes = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (in_quotes) {
      if (c != '"')
        cells.back() += c;
      else if (at + 1 < text.size() && text[at + 1] == '"')
        cells.back() += text[++at];
      else
        in_quotes = false;
    } else if (c == '"') {
      in_quotes = true;
    } else if (c == ',') {
      cells.emplace_back();
    } else if (c == '\n') {
      ++at;
      break;
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

std::string CsvTable::text() const {
  std::string result;
  appendRow(columns, result);
  for (const auto& row : rows) appendRow(row, result);
  return result;
}

CsvTable CsvTable::fromText(const std::string& text, const std::string& name) {
  CsvTable table;
  size_t at = 0;
  table.columns = takeRow(text, at);
  while (at < text.size()) {
    const auto line = 1 + std::count(text.begin(), text.begin() + at, '\n');
    auto row = takeRow(text, at);
    if (row.size() != table.columns.size())
      throw std::runtime_error(name + ":" + std::to_string(line) + ": has " +
                               std::to_string(row.size()) + " cells, the header has " +
                               std::to_string(table.columns.size()));
    table.rows.push_back(std::move(row));
  }
  return table;
}

CsvTable CsvTable::fromFile(const std::string& path) {
  return fromText(readTextFile(path), path);
}

size_t CsvTable::column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::runtime_error("the table has no column '" + name + "'");
  return static_cast<size_t>(found - columns.begin());
}

bool CsvTable::has(const std::string& name) const {
  return std::find(columns.begin(), columns.end(), name) != columns.end();
}

std::string formatDouble(double value) {
  if (std::isnan(value)) return "nan";
  if (value == 0) return "0";
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string formatFixed(double value, int decimals) {
  if (std::isnan(value)) return "nan";
  std::array<char, 64> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                          std::chars_format::fixed, decimals);
  if (error != std::errc()) return formatDouble(value);
  return {buffer.data(), end};
}

bool parseDouble(const std::string& text, double& value) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') ++begin;
  double number;
  const auto [stop, error] = std::from_chars(begin, end, number);
  if (error != std::errc() || stop != end) return false;
  value = number;
  return true;
}

}  // namespace lamp
