#include "FuzzTarget.h"
#include "lamp/core/Ini.h"

using namespace lamp;

namespace {

/** One option of each type. */
struct Options {
  double number = 1.5;
  int count = 3;
  bool flag = true;
  std::string word = "a", text;
  std::vector<double> pose;
  std::vector<std::string> names{"x", "y"};

  void visit(OptionVisitor& v) {
    v("number", number, "m", "a number", kPositive);
    v("count", count, "", "a count", {0, 10});
    v("flag", flag, "a flag");
    v("word", word, "a word", {"a", "b"});
    v("text", text, "any text");
    v("pose", pose, 6, "m", "a pose");
    v("names", names, "some names");
  }
};

std::string written(const std::string& section, Options options) {
  IniOptionWriter writer(section);
  options.visit(writer);
  return writer.text();
}

}  // namespace

/** Options of an ini without a fault are the same when they are written and read again. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Faults faults;
  const Ini ini = Ini::fromText(fuzz::textOf(data, size), "fuzz.ini", faults);
  for (const Ini::Section& section : ini.sections()) {
    Faults wrong = faults;
    Options options, again;
    readOptions(&section, options, wrong);
    if (!wrong.empty()) continue;
    const std::string text = written("again", options);
    const Ini second = Ini::fromText(text, "again.ini", wrong);
    readOptions(second.find("again"), again, wrong);
    fuzz::require(wrong.empty() && written("again", again) == text, "ini round trip:\n" + text);
  }
  return 0;
}
