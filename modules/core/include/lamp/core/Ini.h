#pragma once

#include <string>
#include <vector>

#include "lamp/core/Faults.h"
#include "lamp/core/Options.h"

namespace lamp {

/** An ini file, read strictly.
 *
 * Understands what MRPT's CConfigFile does: `[section]`, `key = value`, `//` comments (at the start
 * of a line or after white space), lines that start with `;` or `#`, a `\` at the end of a line
 * that continues it, `@define NAME VALUE`, `${NAME}` and `$env{NAME}`. Unlike MRPT's it reports
 * what it does not understand: lines that are no key, duplicate keys and sections, unknown
 * variables.
 */
class Ini {
 public:
  struct Entry {
    std::string key, value;
    std::string where;  ///< `file:line`, or `--set`
  };
  struct Section {
    std::string name;
    std::string where;
    std::vector<Entry> entries;

    const Entry* find(const std::string& key) const;
  };

  /** \throws std::runtime_error if it cannot be read or is no text. Its faults go to `faults`. */
  static Ini fromFile(const std::string& path, Faults& faults);
  static Ini fromText(const std::string& text, const std::string& name, Faults& faults);

  /** `section.key=value`, split at the first `=`, then at the last `.` before it. Overrides. */
  void set(const std::string& assignment, Faults& faults);
  void set(const std::string& section, const std::string& key, const std::string& value,
           const std::string& where);

  /** Adds an empty section at the end. */
  Section& addSection(const std::string& name, const std::string& where);
  const std::vector<Section>& sections() const { return sections_; }
  const Section* find(const std::string& section) const;

 private:
  std::vector<Section> sections_;
};

/** Fills options from one section of an ini, and collects malformed values and unknown keys. */
class IniOptionReader : public OptionVisitor {
 public:
  /** \param section may be null: then the defaults stay. */
  IniOptionReader(const Ini::Section* section, Faults& faults);
  /** Reports the keys that no option took. Call after the last option. */
  void reportUnknownKeys();

 protected:
  void onOption(const OptionInfo& info, double& value) override;
  void onOption(const OptionInfo& info, int& value) override;
  void onOption(const OptionInfo& info, bool& value) override;
  void onOption(const OptionInfo& info, std::string& value) override;
  void onOption(const OptionInfo& info, std::vector<double>& value, size_t size) override;
  void onOption(const OptionInfo& info, std::vector<std::string>& value) override;

 private:
  const Ini::Entry* take(const OptionInfo& info);
  void fault(const Ini::Entry& entry, const std::string& message);

  const Ini::Section* section_;
  Faults& faults_;
  std::vector<std::string> known_keys_;
};

/** Calls `visit` on a struct of options and reports unknown keys. */
template <class Options>
void readOptions(const Ini::Section* section, Options& options, Faults& faults) {
  IniOptionReader reader(section, faults);
  options.visit(reader);
  reader.reportUnknownKeys();
}

/** Writes options as a commented ini section that reads back to the same values. */
class IniOptionWriter : public OptionVisitor {
 public:
  explicit IniOptionWriter(const std::string& section);
  const std::string& text() const { return text_; }

 protected:
  void onOption(const OptionInfo& info, double& value) override;
  void onOption(const OptionInfo& info, int& value) override;
  void onOption(const OptionInfo& info, bool& value) override;
  void onOption(const OptionInfo& info, std::string& value) override;
  void onOption(const OptionInfo& info, std::vector<double>& value, size_t size) override;
  void onOption(const OptionInfo& info, std::vector<std::string>& value) override;

 private:
  void line(const OptionInfo& info, const std::string& value);
  std::string text_;
};

template <class Options>
std::string writeOptions(const std::string& section, Options& options) {
  IniOptionWriter writer(section);
  options.visit(writer);
  return writer.text();
}

/** Writes options as the rows of a Markdown table: key, default, unit, meaning. */
class MarkdownOptionWriter : public OptionVisitor {
 public:
  explicit MarkdownOptionWriter(const std::string& section);
  const std::string& text() const { return text_; }

 protected:
  void onOption(const OptionInfo& info, double& value) override;
  void onOption(const OptionInfo& info, int& value) override;
  void onOption(const OptionInfo& info, bool& value) override;
  void onOption(const OptionInfo& info, std::string& value) override;
  void onOption(const OptionInfo& info, std::vector<double>& value, size_t size) override;
  void onOption(const OptionInfo& info, std::vector<std::string>& value) override;

 private:
  void row(const OptionInfo& info, const std::string& value);
  std::string text_;
};

/** `a, b, c` to words without surrounding space; empty text gives an empty list. */
std::vector<std::string> splitWords(const std::string& text, char separator = ',');

}  // namespace lamp
