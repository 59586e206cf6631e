#include "lamp/core/Ini.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <sstream>
#include <stdexcept>

#include "lamp/core/Files.h"

namespace lamp {

namespace {

std::string trimmed(const std::string& text) {
  const char* kSpace = " \t\r\n";
  const size_t begin = text.find_first_not_of(kSpace);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

/** Cuts a `//` comment; `//` inside a word (as in a URL) stays. */
std::string withoutComment(const std::string& line) {
  for (size_t at = line.find("//"); at != std::string::npos; at = line.find("//", at + 1))
    if (at == 0 || std::isspace(static_cast<unsigned char>(line[at - 1])))
      return line.substr(0, at);
  return line;
}

bool hasVariable(const std::string& value) {
  const size_t at = std::min(value.find("${"), value.find("$env{"));
  return at != std::string::npos && value.find('}', at) != std::string::npos;
}

/** Whether the line `key = value` reads back to this value, so that the effective ini gives the
 * same run. Not so after some replacements of variables. */
void requireReadable(const std::string& value, const std::string& where, Faults& faults) {
  const bool cut = trimmed(withoutComment("= " + value).substr(1)) != value;
  const bool goes_on = !value.empty() && value.back() == '\\';
  if (cut || goes_on || hasVariable(value) || value.find('\n') != std::string::npos)
    faults.add(where, "the value '" + value + "' cannot stand in an ini: it must be one line " +
                          "without '//' after a space, '${...}', or '\\' at its end");
}

/** Reads one ini text line by line. */
class IniParser {
 public:
  IniParser(std::string file, Faults& faults, Ini& ini)
      : file_(std::move(file)), faults_(faults), ini_(ini) {}

  void parse(const std::string& text) {
    std::istringstream in(text);
    std::string line, pending;
    int number = 0, first = 0;
    while (std::getline(in, line)) {
      ++number;
      if (pending.empty()) first = number;
      line = trimmed(withoutComment(line));
      if (!line.empty() && line.back() == '\\') {
        pending += trimmed(line.substr(0, line.size() - 1)) + " ";
        continue;
      }
      parseLine(trimmed(pending + line), file_ + ":" + std::to_string(first));
      pending.clear();
    }
    if (!pending.empty()) parseLine(trimmed(pending), file_ + ":" + std::to_string(first));
  }

 private:
  void parseLine(const std::string& line, const std::string& where) {
    if (line.empty() || line[0] == ';' || line[0] == '#') return;
    if (line.rfind("@define", 0) == 0) return parseDefine(line, where);
    if (line[0] == '[') return parseSection(line, where);
    const size_t equal = line.find('=');
    if (equal == std::string::npos || trimmed(line.substr(0, equal)).empty())
      return faults_.add(where, "'" + line + "' is not 'key = value', '[section]' or comment");
    if (section_.empty())
      return faults_.add(where, "'" + line + "' comes before the first [section]");
    const std::string key = trimmed(line.substr(0, equal));
    if (const Ini::Entry* first = ini_.find(section_)->find(key))
      return faults_.add(where, "key '" + key + "' appears twice, first at " + first->where);
    const std::string value = trimmed(expanded(trimmed(line.substr(equal + 1)), where));
    requireReadable(value, where, faults_);
    ini_.set(section_, key, value, where);
  }

  void parseDefine(const std::string& line, const std::string& where) {
    std::istringstream words(line.substr(7));
    std::string name, value;
    words >> name;
    std::getline(words, value);
    if (name.empty()) return faults_.add(where, "'@define' needs a name and a value");
    defines_[name] = expanded(trimmed(value), where);
  }

  void parseSection(const std::string& line, const std::string& where) {
    if (line.back() != ']' || trimmed(line.substr(1, line.size() - 2)).empty())
      return faults_.add(where, "'" + line + "' is not a [section]");
    section_ = trimmed(line.substr(1, line.size() - 2));
    if (const Ini::Section* first = ini_.find(section_))
      return faults_.add(where,
                         "section [" + section_ + "] appears twice, first at " + first->where);
    ini_.addSection(section_, where);
  }

  /** Replaces `${NAME}` and `$env{NAME}`. */
  std::string expanded(std::string value, const std::string& where) {
    for (size_t at = value.find('$'); at != std::string::npos; at = value.find('$', at)) {
      const bool environment = value.compare(at, 5, "$env{") == 0;
      const size_t open = at + (environment ? 4 : 1);
      const size_t close = value.find('}', at);
      if (open >= value.size() || value[open] != '{' || close == std::string::npos) {
        ++at;
        continue;
      }
      const std::string name = value.substr(open + 1, close - open - 1);
      std::string replacement;
      if (environment) {
        if (const char* variable = std::getenv(name.c_str()))
          replacement = variable;
        else
          faults_.add(where, "the environment variable '" + name + "' is not set");
      } else if (const auto found = defines_.find(name); found != defines_.end()) {
        replacement = found->second;
      } else {
        faults_.add(where, "'${" + name + "}' has no '@define " + name + "' above it");
      }
      value.replace(at, close - at + 1, replacement);
      at += replacement.size();
    }
    return value;
  }

  std::string file_;
  Faults& faults_;
  Ini& ini_;
  std::string section_;
  std::map<std::string, std::string> defines_;
};

}  // namespace

const Ini::Entry* Ini::Section::find(const std::string& key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry;
  return nullptr;
}

Ini Ini::fromFile(const std::string& path, Faults& faults) {
  const std::string text = readTextFile(path);
  if (text.find('\0') != std::string::npos)
    throw std::runtime_error("'" + path +
                             "' is not an ini file: it is binary, as rawlogs are; recordings come "
                             "after the ini");
  return fromText(text, path, faults);
}

Ini Ini::fromText(const std::string& text, const std::string& name, Faults& faults) {
  Ini ini;
  IniParser(name, faults, ini).parse(text);
  return ini;
}

const Ini::Section* Ini::find(const std::string& section) const {
  for (const Section& candidate : sections_)
    if (candidate.name == section) return &candidate;
  return nullptr;
}

Ini::Section& Ini::addSection(const std::string& name, const std::string& where) {
  sections_.push_back({name, where, {}});
  return sections_.back();
}

void Ini::set(const std::string& section, const std::string& key, const std::string& value,
              const std::string& where) {
  auto found = std::find_if(sections_.begin(), sections_.end(),
                            [&](const Section& s) { return s.name == section; });
  Section& target = found == sections_.end() ? addSection(section, where) : *found;
  for (Entry& entry : target.entries)
    if (entry.key == key) {
      entry.value = value;
      entry.where = where;
      return;
    }
  target.entries.push_back({key, value, where});
}

void Ini::set(const std::string& assignment, Faults& faults) {
  const size_t equal = assignment.find('=');
  const size_t dot = equal == std::string::npos ? equal : assignment.rfind('.', equal);
  if (dot == std::string::npos || dot == 0 || dot + 1 == equal) {
    faults.add("--set", "'" + assignment + "' is not of the form section.key=value");
    return;
  }
  const std::string value = trimmed(assignment.substr(equal + 1));
  requireReadable(value, "--set " + assignment, faults);
  set(trimmed(assignment.substr(0, dot)), trimmed(assignment.substr(dot + 1, equal - dot - 1)),
      value, "--set " + assignment);
}

std::vector<std::string> splitWords(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::istringstream in(text);
  std::string word;
  while (std::getline(in, word, separator))
    if (const std::string clean = trimmed(word); !clean.empty()) words.push_back(clean);
  return words;
}

}  // namespace lamp
