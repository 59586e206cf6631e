#include "TumText.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Csv.h"

namespace lamp {

namespace {

const char* const kColumns = "'stamp x y z qx qy qz qw'";

bool startsWith(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

void refuseOtherKinds(const std::string& text, const std::string& where) {
  if (startsWith(text, "PK"))
    throw std::runtime_error(where +
                             ": is a spreadsheet or an archive; save the sheet as text "
                             "(CSV) with the columns " +
                             kColumns);
  if (startsWith(text, "\xFF\xFE") || startsWith(text, "\xFE\xFF") ||
      text.find('\0') != std::string::npos)
    throw std::runtime_error(where + ": is not plain text, or is in UTF-16; save it as UTF-8");
}

/** The line's columns. Where semicolons separate them, commas are decimal points. */
std::vector<std::string> columnsOf(std::string line) {
  line = line.substr(0, line.find('#'));
  if (line.find(';') != std::string::npos) std::replace(line.begin(), line.end(), ',', '.');
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == ',' || c == ';' || std::isspace(c); },
      ' ');
  std::istringstream words(line);
  std::vector<std::string> columns;
  for (std::string word; words >> word;) columns.push_back(word);
  return columns;
}

bool isHeader(const std::vector<std::string>& columns) {
  double value = 0;
  return std::none_of(columns.begin(), columns.end(),
                      [&](const std::string& word) { return parseDouble(word, value); });
}

/** EuRoC and others put the real part first. */
void checkOrder(const std::vector<std::string>& header, const std::string& where) {
  for (size_t i = 0; i + 1 < header.size(); ++i) {
    std::string name = header[i];
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (name == "qw" || name == "q_w" || name == "w")
      throw std::runtime_error(where + ": has the column '" + header[i] +
                               "' before the last; order the columns as " + kColumns);
  }
}

TumRow parseRow(const std::vector<std::string>& columns, int line, const std::string& where) {
  TumRow row;
  row.line = line;
  if (columns.size() != row.values.size())
    throw std::runtime_error(where + ": has " + std::to_string(columns.size()) +
                             " columns; is no " + kColumns);
  for (size_t i = 0; i < columns.size(); ++i)
    if (!parseDouble(columns[i], row.values[i]) || !std::isfinite(row.values[i]))
      throw std::runtime_error(where + ": '" + columns[i] + "' is not a number; is no " + kColumns);
  return row;
}

}  // namespace

std::vector<TumRow> parseTum(const std::string& text, const std::string& where) {
  refuseOtherKinds(text, where);
  static const std::string kByteOrderMark = "\xEF\xBB\xBF";
  std::istringstream in(startsWith(text, kByteOrderMark) ? text.substr(kByteOrderMark.size())
                                                         : text);
  std::vector<TumRow> rows;
  bool header_seen = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string here = where + ":" + std::to_string(number);
    const auto columns = columnsOf(line);
    if (columns.empty()) continue;
    if (rows.empty() && !header_seen && isHeader(columns)) {
      checkOrder(columns, here);
      header_seen = true;
      continue;
    }
    rows.push_back(parseRow(columns, number, here));
  }
  return rows;
}

}  // namespace lamp
