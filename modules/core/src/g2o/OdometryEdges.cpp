#include "lamp/core/OdometryEdges.h"

#include <charconv>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Files.h"
#include "lamp/core/Ini.h"
#include "lamp/core/Program.h"

namespace lamp {

namespace {

constexpr OdometryRule kNamed[] = {OdometryRule::kAuto, OdometryRule::kIds, OdometryRule::kNext,
                                   OdometryRule::kVertices, OdometryRule::kEdges};

std::string unknown(const std::string& text) {
  std::string names;
  for (const OdometryRule rule : kNamed) names += std::string(toString(rule)) + ", ";
  return "odometry edges '" + text + "': there is no such file, and it is not one of " +
         names.substr(0, names.size() - 2);
}

bool parseId(const std::string& word, uint64_t& id) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

const char* toString(OdometryRule rule) {
  switch (rule) {
    case OdometryRule::kAuto:
      return "auto";
    case OdometryRule::kIds:
      return "ids";
    case OdometryRule::kNext:
      return "next";
    case OdometryRule::kVertices:
      return "vertices";
    case OdometryRule::kEdges:
      return "edges";
    case OdometryRule::kListed:
      return "listed";
  }
  return "";
}

OdometryEdges odometryEdgesFrom(const std::string& text) {
  for (const OdometryRule rule : kNamed)
    if (text == toString(rule)) return {rule, {}};
  if (!std::filesystem::exists(text)) throw UsageError(unknown(text));
  OdometryEdges edges{OdometryRule::kListed, {}};
  std::istringstream in(readTextFile(text));
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::vector<std::string> words;
    for (const std::string& part : splitWords(line.substr(0, line.find('#')), ' '))
      for (const std::string& word : splitWords(part, '\t')) words.push_back(word);
    if (words.empty()) continue;
    auto& [from, to] = edges.pairs.emplace_back();
    if (words.size() != 2 || !parseId(words[0], from) || !parseId(words[1], to) || from == to)
      throw std::runtime_error(text + ":" + std::to_string(number) +
                               ": is not a pair of ids, such as '17 18'");
  }
  return edges;
}

}  // namespace lamp
