#include "lamp/core/Stage.h"

#include <mrpt/core/initializer.h>

namespace lamp {

/** A stage that the test program does not know at build time. */
class PluginStage : public Stage {
  DEFINE_MRPT_OBJECT(PluginStage, lamp)

 public:
  void visit(OptionVisitor& v) override { v("gain", gain_, "", "some number"); }

 private:
  double gain_ = 1.0;
};

}  // namespace lamp

IMPLEMENTS_MRPT_OBJECT(PluginStage, lamp::Stage, lamp)

MRPT_INITIALIZER(registerAllClasses_lamp_test_plugin) {
  mrpt::rtti::registerClass(CLASS_ID_NAMESPACE(PluginStage, lamp));
}
