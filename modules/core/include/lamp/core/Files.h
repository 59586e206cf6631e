#pragma once

#include <functional>
#include <istream>
#include <memory>
#include <ostream>
#include <string>

namespace lamp {

/** Calls `write` with a temporary path in the same folder and renames the result to `path`, so that
 * a killed run leaves no half file. Through a symbolic link the file that it names is written; a
 * device or a pipe is written to as it is. \throws std::runtime_error naming the path; what `write`
 * throws goes through, and the temporary file is removed. */
void writeAtomically(const std::string& path, const std::function<void(const std::string&)>& write);

/** Lets `write` fill a new binary file with writeAtomically(). \throws std::runtime_error naming
 * the path and the system's reason. */
void writeBinaryFile(const std::string& path, const std::function<void(std::ostream&)>& write);

/** Writes text with writeAtomically(). */
void writeTextFile(const std::string& path, const std::string& text);

/** A binary file to read from. \throws std::runtime_error naming the path. */
std::unique_ptr<std::istream> openedToRead(const std::string& path);

/** Removes the temporary files of writeAtomically() on all threads. For the moment before a signal
 * ends the program: no file can be begun or completed after. */
void removeUnfinishedFiles();

/** \throws std::runtime_error naming the path. */
std::string readTextFile(const std::string& path);

}  // namespace lamp
