#pragma once

#include <string>
#include <vector>

namespace lamp::evaluation {

/** Draws with gnuplot, and leaves its scripts and data beside the pictures, so that they can be
 * restyled and drawn again: `gnuplot NAME.gp` in their folder. */
class Gnuplot {
 public:
  /** Makes the folder. \throws std::runtime_error if that fails. */
  explicit Gnuplot(const std::string& folder);

  /** Writes `NAME.dat` and `NAME.gp`, and draws `NAME.png`.
   * \param script plots 'NAME.dat'; the terminal and the output are set already.
   * \throws std::runtime_error if a file cannot be written. */
  void draw(const std::string& name, int width, int height, const std::string& script,
            const std::string& data);
  /** What kept pictures from being drawn; each reason once. */
  const std::vector<std::string>& warnings() const { return warnings_; }

  /** A gnuplot string of any text. */
  static std::string quoted(const std::string& text);

 private:
  std::string folder_;
  std::vector<std::string> warnings_;
};

/** Colours of robots and runs, that people with colour blindness can tell apart (Okabe, Ito). */
std::string lineColor(size_t index);

}  // namespace lamp::evaluation
