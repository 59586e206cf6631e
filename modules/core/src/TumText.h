#pragma once

#include <array>
#include <string>
#include <vector>

namespace lamp {

/** One line of a trajectory file: `stamp x y z qx qy qz qw`. */
struct TumRow {
  int line = 0;
  std::array<double, 8> values{};
};

/** Rows of a TUM file, in file order, as other programs and spreadsheets write it too: columns
 * separated by spaces, tabs, commas or semicolons (then commas may be decimal points), a byte order
 * mark, a line with the columns' names, `#` before comments.
 *  \param where names the file in errors.
 *  \throws std::runtime_error with the line, and what to do, for all else. */
std::vector<TumRow> parseTum(const std::string& text, const std::string& where);

}  // namespace lamp
