#include "Gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp::evaluation {

namespace {

/** Runs `gnuplot SCRIPT` in a folder, without a shell. \return what went wrong, or nothing. */
std::string runGnuplot(const std::string& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  ::posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "gnuplot", argument = script;
  std::array<char*, 3> argv = {program.data(), argument.data(), nullptr};
  pid_t pid = 0;
  const int error = ::posix_spawnp(&pid, "gnuplot", &actions, nullptr, argv.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT)
    return "gnuplot is missing, so there are no pictures: install gnuplot-nox, or draw the scripts "
           "in '" +
           folder + "' elsewhere";
  if (error != 0) return std::string("gnuplot does not start: ") + std::strerror(error);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  const bool good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  return good ? "" : "gnuplot failed on '" + folder + "/" + script + "'";
}

}  // namespace

Gnuplot::Gnuplot(const std::string& folder) : folder_(folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::runtime_error("cannot make the folder '" + folder + "': " + error.message());
}

void Gnuplot::draw(const std::string& name, int width, int height, const std::string& script,
                   const std::string& data) {
  writeTextFile(folder_ + "/" + name + ".dat", data);
  // Names have underscores, which "enhanced" text would make subscripts.
  writeTextFile(folder_ + "/" + name + ".gp",
                "set terminal pngcairo noenhanced size " + std::to_string(width) + "," +
                    std::to_string(height) +
                    " font 'sans,15' background '#ffffff'\n"
                    "set output '" +
                    name +
                    ".png'\nset border lc '#666666'\nset grid lt 1 lc '#dddddd' lw 1\n"
                    "set key outside right top vertical Left reverse samplen 2\n" +
                    script);
  const std::string failure = runGnuplot(folder_, name + ".gp");
  if (!failure.empty() && std::find(warnings_.begin(), warnings_.end(), failure) == warnings_.end())
    warnings_.push_back(failure);
}

std::string Gnuplot::quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += "''";
    else
      result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return result + "'";
}

std::string lineColor(size_t index) {
  static const std::array<const char*, 7> kColors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                     "#e69f00", "#56b4e9", "#7f3c8d"};
  return std::string("'") + kColors[index % kColors.size()] + "'";
}

}  // namespace lamp::evaluation
