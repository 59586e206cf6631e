#pragma once

#include <mrpt/rtti/CObject.h>
#include <mrpt/system/COutputLogger.h>

#include <memory>
#include <string>
#include <vector>

#include "lamp/core/Faults.h"
#include "lamp/core/Ini.h"
#include "lamp/core/Options.h"

namespace lamp {

/** Base of everything that the ini can choose by name. A stage takes values and gives values: no
 * files, no ini, no threads, no windows. Made by name through MRPT's class factory. */
class Stage : public mrpt::rtti::CObject, public mrpt::system::COutputLogger {
  DEFINE_VIRTUAL_MRPT_OBJECT(Stage)

 public:
  /** Lists the stage's options; most stages forward to their options struct. */
  virtual void visit(OptionVisitor& options) = 0;
};

/** How the ini names a stage: `Class`, or `Class@name` for several instances of one class. Its
 * options are in the section `[lamp::Class]` or `[lamp::Class@name]`. */
struct StageName {
  std::string class_name;  ///< without the namespace
  std::string instance;    ///< empty for the plain form

  static StageName parse(const std::string& text);
  std::string text() const;
  std::string section() const { return "lamp::" + text(); }
};

/** Registers the stage base class; modules register their own classes. */
void registerAllClasses_lamp_core();

/** Loads plugin libraries, whose initialisers register further stages.
 *  \throws std::runtime_error naming the library and the loader's reason. */
void loadPlugins(const std::vector<std::string>& libraries);

/** Names (without `lamp::`) of the registered classes that derive from `base`, sorted. */
std::vector<std::string> stageClasses(const mrpt::rtti::TRuntimeClassId* base);

/** Makes the stage and reads its options from the ini.
 *  \return null after adding a fault that lists the known names. */
std::shared_ptr<Stage> makeStage(const StageName& name, const mrpt::rtti::TRuntimeClassId* base,
                                 const std::string& kind, const std::string& where, const Ini& ini,
                                 Faults& faults);

template <class Base>
std::shared_ptr<Base> makeStage(const StageName& name, const std::string& kind,
                                const std::string& where, const Ini& ini, Faults& faults) {
  return std::dynamic_pointer_cast<Base>(makeStage(name, CLASS_ID(Base), kind, where, ini, faults));
}

}  // namespace lamp
