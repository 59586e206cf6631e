#include "lamp/pose_graph/ChanceAgreement.h"
#include "lamp/pose_graph/Gnc.h"
#include "lamp/pose_graph/Icm.h"
#include "lamp/pose_graph/OdometryGate.h"
#include "lamp/pose_graph/PlainOptimizers.h"
#include "lamp/pose_graph/RobotFrames.h"

namespace lamp {

void registerAllClasses_lamp_pose_graph() {
  mrpt::rtti::registerClass(CLASS_ID(OutlierRejection));
  mrpt::rtti::registerClass(CLASS_ID(OdometryGate));
  mrpt::rtti::registerClass(CLASS_ID(ChanceAgreement));
  mrpt::rtti::registerClass(CLASS_ID(Icm));
  mrpt::rtti::registerClass(CLASS_ID(RobotFrames));
  mrpt::rtti::registerClass(CLASS_ID(Optimizer));
  mrpt::rtti::registerClass(CLASS_ID(Lm));
  mrpt::rtti::registerClass(CLASS_ID(Gn));
  mrpt::rtti::registerClass(CLASS_ID(CeresLm));
  mrpt::rtti::registerClass(CLASS_ID(Gnc));
}

}  // namespace lamp
