#include "lamp/core/Stage.h"

#include <mrpt/system/os.h>

#include <algorithm>
#include <stdexcept>

IMPLEMENTS_VIRTUAL_MRPT_OBJECT(Stage, mrpt::rtti::CObject, lamp)

namespace lamp {

namespace {
const std::string kNamespace = "lamp::";
}

StageName StageName::parse(const std::string& text) {
  const size_t at = text.find('@');
  if (at == std::string::npos) return {text, ""};
  return {text.substr(0, at), text.substr(at + 1)};
}

std::string StageName::text() const {
  return instance.empty() ? class_name : class_name + "@" + instance;
}

void registerAllClasses_lamp_core() {
  mrpt::rtti::registerClass(CLASS_ID(Stage));
}

void loadPlugins(const std::vector<std::string>& libraries) {
  for (const std::string& library : libraries) {
    std::string reason;
    if (!mrpt::system::loadPluginModule(library, std::ref(reason)))
      throw std::runtime_error("[plugins] load: cannot load '" + library + "': " + reason);
  }
}

std::vector<std::string> stageClasses(const mrpt::rtti::TRuntimeClassId* base) {
  std::vector<std::string> names;
  for (const auto* id : mrpt::rtti::getAllRegisteredClassesChildrenOf(base)) {
    const std::string name = id->className;
    if (id->ptrCreateObject && name.rfind(kNamespace, 0) == 0)
      names.push_back(name.substr(kNamespace.size()));
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::shared_ptr<Stage> makeStage(const StageName& name, const mrpt::rtti::TRuntimeClassId* base,
                                 const std::string& kind, const std::string& where, const Ini& ini,
                                 Faults& faults) {
  const std::vector<std::string> known = stageClasses(base);
  if (std::find(known.begin(), known.end(), name.class_name) == known.end()) {
    std::string list;
    for (const std::string& class_name : known) list += (list.empty() ? "" : ", ") + class_name;
    faults.add(where, "there is no " + kind + " '" + name.class_name + "'" +
                          didYouMean(name.class_name, known) + "; known: " + list);
    return nullptr;
  }
  auto stage =
      std::dynamic_pointer_cast<Stage>(mrpt::rtti::classFactory(kNamespace + name.class_name));
  stage->setLoggerName(name.text());
  readOptions(ini.find(name.section()), *stage, faults);
  return stage;
}

}  // namespace lamp
