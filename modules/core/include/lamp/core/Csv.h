#pragma once

#include <istream>
#include <string>
#include <vector>

namespace lamp {

/** A table with a header row; columns are found by name. Cells with commas, quotes or line breaks
 * are quoted as in RFC 4180. */
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  std::string text() const;
  /** Takes each character of the stream once; a byte order mark is skipped. \throws
   * std::runtime_error naming file and line if a row's length differs from the header's, or a quote
   * is never closed. \param name of the file, for messages. */
  static CsvTable read(std::istream& in, const std::string& name);
  static CsvTable fromText(const std::string& text, const std::string& name);
  static CsvTable fromFile(const std::string& path);

  /** \throws std::runtime_error naming the column. */
  size_t column(const std::string& name) const;
  bool has(const std::string& name) const;
};

/** Shortest decimal text that reads back to the same double; `nan`, `inf`, `-inf` as such. */
std::string formatDouble(double value);
/** With a fixed number of decimals. */
std::string formatFixed(double value, int decimals);
/** The whole text must be one number. \return false otherwise; `value` stays as it was then. */
bool parseDouble(const std::string& text, double& value);

}  // namespace lamp
