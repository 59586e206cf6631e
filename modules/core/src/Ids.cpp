#include "lamp/core/Ids.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <limits>
#include <stdexcept>

namespace lamp {

namespace {

bool isNameCharacter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
}

constexpr int kSymbolLetterShift = 56;
constexpr char kAnchorKey = 'u';

/** One byte a robot, in the order in which they are given out. */
const std::string& allKeys() {
  static const std::string all = [] {
    std::string keys = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    for (int byte = 0x80; byte <= 0xFF; ++byte) keys += static_cast<char>(byte);
    return keys;
  }();
  return all;
}

}  // namespace

RobotId RobotTable::add(const std::string& name, char letter) {
  if (name.empty() || !std::all_of(name.begin(), name.end(), isNameCharacter))
    throw std::runtime_error("robot name '" + name + "': use letters, digits, '_' and '-' only");
  if (find(name)) throw std::runtime_error("two robots are named '" + name + "'");
  if (letter == 0) letter = nextLetter();
  if (allKeys().find(letter) == std::string::npos)
    throw std::runtime_error("robot '" + name + "': its key must be one letter or digit");
  if (letterTaken(letter))
    throw std::runtime_error("robot '" + name + "': the key '" + std::string(1, letter) +
                             "' is taken by another robot");
  robots_.push_back({name, letter});
  return RobotId{static_cast<uint16_t>(robots_.size() - 1)};
}

std::optional<RobotId> RobotTable::find(const std::string& name) const {
  for (size_t i = 0; i < robots_.size(); ++i)
    if (robots_[i].name == name) return RobotId{static_cast<uint16_t>(i)};
  return std::nullopt;
}

std::vector<RobotId> RobotTable::ids() const {
  std::vector<RobotId> all;
  for (size_t i = 0; i < robots_.size(); ++i) all.push_back(RobotId{static_cast<uint16_t>(i)});
  return all;
}

bool RobotTable::letterTaken(char letter) const {
  return std::any_of(robots_.begin(), robots_.end(),
                     [&](const Robot& robot) { return robot.letter == letter; });
}

char RobotTable::nextLetter() const {
  for (const char key : allKeys())
    if (key != kAnchorKey && !letterTaken(key)) return key;
  throw std::runtime_error("more than " + std::to_string(allKeys().size() - 1) +
                           " robots: no byte is left for the symbols of their key nodes");
}

std::string RobotTable::format(KeyNodeId id) const {
  return name(id.robot) + ":" + std::to_string(id.index);
}

KeyNodeId RobotTable::parse(const std::string& text) const {
  const size_t colon = text.rfind(':');
  const std::string digits = colon == std::string::npos ? "" : text.substr(colon + 1);
  const char* end = digits.data() + digits.size();
  uint32_t index = 0;
  const auto [stop, error] = std::from_chars(digits.data(), end, index);
  const bool is_number = error == std::errc() && stop == end;
  const auto robot = is_number ? find(text.substr(0, colon)) : std::nullopt;
  if (!robot) throw std::runtime_error("'" + text + "' is not a key node of a known robot");
  return {*robot, index};
}

uint64_t RobotTable::symbol(KeyNodeId id) const {
  return (static_cast<uint64_t>(static_cast<unsigned char>(letter(id.robot)))
          << kSymbolLetterShift) |
         id.index;
}

KeyNodeId RobotTable::fromSymbol(uint64_t symbol) const {
  const char letter = static_cast<char>(symbol >> kSymbolLetterShift);
  const uint64_t index = symbol & ((uint64_t{1} << kSymbolLetterShift) - 1);
  if (index > std::numeric_limits<uint32_t>::max())
    throw std::runtime_error("symbol " + std::to_string(symbol) + " has an index above 32 bits");
  for (size_t i = 0; i < robots_.size(); ++i)
    if (robots_[i].letter == letter)
      return {RobotId{static_cast<uint16_t>(i)}, static_cast<uint32_t>(index)};
  throw std::runtime_error("symbol " + std::to_string(symbol) + " belongs to no known robot");
}

std::string robotNameFromStem(const std::string& stem) {
  std::string name = stem;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !isNameCharacter(c); }, '_');
  return name.empty() ? "robot" : name;
}

}  // namespace lamp
