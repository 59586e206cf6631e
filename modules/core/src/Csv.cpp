#include "lamp/core/Csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp {

namespace {

constexpr char kByteOrderMark[] = "\xEF\xBB\xBF";

std::string quoted(const std::string& cell) {
  // A mark that is part of the first cell must not be read as the file's.
  if (cell.find_first_of(",\"\r\n") == std::string::npos && cell.rfind(kByteOrderMark, 0) != 0)
    return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

void appendRow(const std::vector<std::string>& cells, std::string& text) {
  for (size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : ",") + quoted(cells[i]);
  text += "\n";
}

/** Takes rows off a stream, each character once, and knows the line that it is at. */
class RowReader {
 public:
  RowReader(std::istream& in, const std::string& name) : text_(*in.rdbuf()), name_(name) {
    size_t matched = 0;
    for (; kByteOrderMark[matched] && peek() == byte(kByteOrderMark[matched]); ++matched) take();
    if (!kByteOrderMark[matched]) return;
    for (; matched > 0; --matched) text_.sungetc();
  }

  bool atEnd() { return peek() == EOF; }
  size_t line() const { return line_; }

  /** Across quoted line breaks. */
  std::vector<std::string> takeRow() {
    std::vector<std::string> cells(1);
    for (int c = take(); c != EOF && c != '\n'; c = take()) {
      if (c == '"')
        takeQuoted(cells.back());
      else if (c == ',')
        cells.emplace_back();
      else if (c != '\r')
        cells.back() += static_cast<char>(c);
    }
    return cells;
  }

 private:
  static int byte(char c) { return static_cast<unsigned char>(c); }
  int peek() { return text_.sgetc(); }
  int take() {
    const int c = text_.sbumpc();
    line_ += c == '\n' ? 1 : 0;
    return c;
  }

  /** Called behind the opening quote; reads to behind the closing one. */
  void takeQuoted(std::string& cell) {
    const size_t first_line = line_;
    for (int c = take();; c = take()) {
      if (c == EOF)
        throw std::runtime_error(name_ + ":" + std::to_string(first_line) +
                                 ": a quote is opened here and never closed");
      if (c == '"' && peek() != '"') return;
      if (c == '"') take();
      cell += static_cast<char>(c);
    }
  }

  std::streambuf& text_;
  const std::string& name_;
  size_t line_ = 1;
};

}  // namespace

std::string CsvTable::text() const {
  std::string result;
  appendRow(columns, result);
  for (const auto& row : rows) appendRow(row, result);
  return result;
}

CsvTable CsvTable::read(std::istream& in, const std::string& name) {
  RowReader reader(in, name);
  CsvTable table;
  table.columns = reader.takeRow();
  while (!reader.atEnd()) {
    const size_t line = reader.line();
    auto row = reader.takeRow();
    if (row.size() != table.columns.size())
      throw std::runtime_error(name + ":" + std::to_string(line) + ": has " +
                               std::to_string(row.size()) + " cells, the header has " +
                               std::to_string(table.columns.size()));
    table.rows.push_back(std::move(row));
  }
  return table;
}

CsvTable CsvTable::fromText(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  return read(in, name);
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
