#include <algorithm>
#include <cmath>
#include <limits>

#include "lamp/core/Csv.h"
#include "lamp/core/Ini.h"

namespace lamp {

namespace {

std::string describe(const Range& range) {
  const std::string above = range.min == kPositive.min ? "must be above 0"
                            : std::isfinite(range.min)
                                ? "must be at least " + formatDouble(range.min)
                                : "";
  if (!std::isfinite(range.max)) return above;
  return (above.empty() ? "must be" : above + " and") + " at most " + formatDouble(range.max);
}

std::string join(const std::vector<std::string>& words, const char* separator) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : separator) + word;
  return text;
}

std::string format(const std::vector<double>& values) {
  if (values.empty()) return "";
  std::vector<std::string> words;
  for (const double value : values) words.push_back(formatDouble(value));
  return "[" + join(words, " ") + "]";
}

std::string comment(const OptionInfo& info) {
  std::string text = info.meaning;
  if (!info.choices.empty()) text += ": " + join(info.choices, " | ");
  if (!info.unit.empty()) text += " [" + info.unit + "]";
  return text;
}

}  // namespace

IniOptionReader::IniOptionReader(const Ini::Section* section, Faults& faults)
    : section_(section), faults_(faults) {}

const Ini::Entry* IniOptionReader::take(const OptionInfo& info) {
  known_keys_.push_back(info.key);
  return section_ ? section_->find(info.key) : nullptr;
}

void IniOptionReader::fault(const Ini::Entry& entry, const std::string& message) {
  faults_.add(entry.where,
              "[" + section_->name + "] " + entry.key + " = " + entry.value + ": " + message);
}

void IniOptionReader::reportUnknownKeys() {
  if (!section_) return;
  for (const Ini::Entry& entry : section_->entries)
    if (std::find(known_keys_.begin(), known_keys_.end(), entry.key) == known_keys_.end())
      faults_.add(entry.where, "[" + section_->name + "] has no key '" + entry.key + "'" +
                                   didYouMean(entry.key, known_keys_));
}

void IniOptionReader::onOption(const OptionInfo& info, double& value) {
  const Ini::Entry* entry = take(info);
  if (!entry) return;
  double number;
  if (!parseDouble(entry->value, number) || std::isnan(number))
    fault(*entry, "is not a number");
  else if (number < info.range.min || number > info.range.max)
    fault(*entry, describe(info.range));
  else
    value = number;
}

void IniOptionReader::onOption(const OptionInfo& info, int& value) {
  const Ini::Entry* entry = take(info);
  if (!entry) return;
  double number;
  if (!parseDouble(entry->value, number) || number != std::floor(number) ||
      std::abs(number) > std::numeric_limits<int>::max())
    fault(*entry, "is not a whole number");
  else if (number < info.range.min || number > info.range.max)
    fault(*entry, describe(info.range));
  else
    value = static_cast<int>(number);
}

void IniOptionReader::onOption(const OptionInfo& info, bool& value) {
  const Ini::Entry* entry = take(info);
  if (!entry) return;
  const std::string& text = entry->value;
  if (text == "true" || text == "1" || text == "yes")
    value = true;
  else if (text == "false" || text == "0" || text == "no")
    value = false;
  else
    fault(*entry, "must be true or false");
}

void IniOptionReader::onOption(const OptionInfo& info, std::string& value) {
  const Ini::Entry* entry = take(info);
  if (!entry) return;
  const auto& choices = info.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), entry->value) == choices.end())
    fault(*entry, "must be one of: " + join(choices, ", "));
  else
    value = entry->value;
}

void IniOptionReader::onOption(const OptionInfo& info, std::vector<double>& value, size_t size) {
  const Ini::Entry* entry = take(info);
  if (!entry) return;
  std::string text = entry->value;
  if (text.size() >= 2 && text.front() == '[' && text.back() == ']')
    text = text.substr(1, text.size() - 2);
  std::replace(text.begin(), text.end(), ',', ' ');
  std::vector<double> numbers;
  for (const std::string& word : splitWords(text, ' ')) {
    double number;
    if (!parseDouble(word, number) || std::isnan(number))
      return fault(*entry, "'" + word + "' is not a number");
    if (number < info.range.min || number > info.range.max)
      return fault(*entry, describe(info.range));
    numbers.push_back(number);
  }
  if (size != 0 && !numbers.empty() && numbers.size() != size)
    return fault(*entry, "needs " + std::to_string(size) + " numbers, has " +
                             std::to_string(numbers.size()));
  value = numbers;
}

void IniOptionReader::onOption(const OptionInfo& info, std::vector<std::string>& value) {
  if (const Ini::Entry* entry = take(info)) value = splitWords(entry->value);
}

IniOptionWriter::IniOptionWriter(const std::string& section) : text_("[" + section + "]\n") {}

void IniOptionWriter::line(const OptionInfo& info, const std::string& value) {
  text_ += "// " + comment(info) + "\n" + info.key + " = " + value + "\n";
}

void IniOptionWriter::onOption(const OptionInfo& info, double& value) {
  line(info, formatDouble(value));
}
void IniOptionWriter::onOption(const OptionInfo& info, int& value) {
  line(info, std::to_string(value));
}
void IniOptionWriter::onOption(const OptionInfo& info, bool& value) {
  line(info, value ? "true" : "false");
}
void IniOptionWriter::onOption(const OptionInfo& info, std::string& value) {
  line(info, value);
}
void IniOptionWriter::onOption(const OptionInfo& info, std::vector<double>& value, size_t) {
  line(info, format(value));
}
void IniOptionWriter::onOption(const OptionInfo& info, std::vector<std::string>& value) {
  line(info, join(value, ", "));
}

MarkdownOptionWriter::MarkdownOptionWriter(const std::string& section)
    : text_("### [" + section + "]\n\n| key | default | unit | meaning |\n|---|---|---|---|\n") {}

void MarkdownOptionWriter::row(const OptionInfo& info, const std::string& value) {
  std::string meaning = info.meaning;
  if (!info.choices.empty()) meaning += ": " + join(info.choices, ", ");
  text_ += "| `" + info.key + "` | " + (value.empty() ? "" : "`" + value + "`") + " | " +
           info.unit + " | " + meaning + " |\n";
}

void MarkdownOptionWriter::onOption(const OptionInfo& info, double& value) {
  row(info, formatDouble(value));
}
void MarkdownOptionWriter::onOption(const OptionInfo& info, int& value) {
  row(info, std::to_string(value));
}
void MarkdownOptionWriter::onOption(const OptionInfo& info, bool& value) {
  row(info, value ? "true" : "false");
}
void MarkdownOptionWriter::onOption(const OptionInfo& info, std::string& value) {
  row(info, value);
}
void MarkdownOptionWriter::onOption(const OptionInfo& info, std::vector<double>& value, size_t) {
  row(info, format(value));
}
void MarkdownOptionWriter::onOption(const OptionInfo& info, std::vector<std::string>& value) {
  row(info, join(value, ", "));
}

}  // namespace lamp
