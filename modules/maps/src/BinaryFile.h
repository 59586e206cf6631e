#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace lamp {

/** Lets `write` fill a new binary file, which replaces `path` only when all of it is written.
 * \throws std::runtime_error naming the path and the system's reason. */
void writeBinaryFile(const std::string& path, const std::function<void(std::ostream&)>& write);

}  // namespace lamp
