#pragma once

#include <functional>
#include <string>
#include <vector>

namespace lamp::evaluation {

/** Calls `take` for each row of a text file of numbers between spaces; `#` starts a comment.
 *  \param meaning of a row, for messages.
 *  \throws std::runtime_error with file and line if a row has not `columns` finite numbers, or the
 *  file has no row. */
void readNumberRows(const std::string& path, size_t columns, const std::string& meaning,
                    const std::function<void(const std::vector<double>&)>& take);

}  // namespace lamp::evaluation
