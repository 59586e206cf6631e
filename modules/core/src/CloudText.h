#pragma once

#include <Eigen/Core>
#include <istream>
#include <string>
#include <vector>

namespace lamp {

/** The lines of a text that holds points, with their numbers for messages. */
class CloudText {
 public:
  /** \param file outlives it; \param name of the file, for messages; \param line of the text so
   * far. */
  CloudText(std::istream& file, std::string name, size_t line = 0)
      : file_(file), name_(std::move(name)), line_(line) {}

  /** The words of the next line that has any; a byte order mark before the first line is skipped.
   * \return false at the end of the file. */
  bool next(std::vector<std::string>& words);
  size_t line() const { return line_; }

  /** The number that a word of the current line stands for.
   * \throws std::runtime_error naming the line, and what to do about a decimal comma. */
  double number(const std::string& word) const;
  /** \throws std::runtime_error naming the current line. */
  [[noreturn]] void fail(const std::string& what) const { failAt(line_, what); }
  [[noreturn]] void failAt(size_t line, const std::string& what) const;

 private:
  std::istream& file_;
  const std::string name_;
  size_t line_;
};

/** Takes the numbers of a comment `offset X Y Z`: what to add to the points for world coordinates.
 * Other programs' comments may begin with the same word: only three numbers are an offset.
 * \param words of a line that is a comment. */
void takeOffset(const std::vector<std::string>& words, Eigen::Vector3d& offset);

}  // namespace lamp
