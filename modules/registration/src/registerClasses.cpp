#include "lamp/registration/LoopClosureComputation.h"

#include "lamp/registration/BothDirections.h"
#include "lamp/registration/FreeSpaceConsistency.h"
#include "lamp/registration/GuessAligners.h"
#include "lamp/registration/GuessDeviation.h"
#include "lamp/registration/OverlapResidual.h"
#include "lamp/registration/PclFitness.h"
#include "lamp/registration/PlanarSearch.h"
#include "lamp/registration/SacIa.h"
#include "lamp/registration/Teaser.h"

namespace lamp {

void registerAllClasses_lamp_registration() {
  mrpt::rtti::registerClass(CLASS_ID(InitialAligner));
  mrpt::rtti::registerClass(CLASS_ID(IdentityGuess));
  mrpt::rtti::registerClass(CLASS_ID(OdometryGuess));
  mrpt::rtti::registerClass(CLASS_ID(OdometryRotationGuess));
  mrpt::rtti::registerClass(CLASS_ID(SacIa));
  mrpt::rtti::registerClass(CLASS_ID(Teaser));
  mrpt::rtti::registerClass(CLASS_ID(PlanarSearch));
  mrpt::rtti::registerClass(CLASS_ID(Refiner));
  mrpt::rtti::registerClass(CLASS_ID(Gicp));
  mrpt::rtti::registerClass(CLASS_ID(PointToPlane));
  mrpt::rtti::registerClass(CLASS_ID(Verifier));
  mrpt::rtti::registerClass(CLASS_ID(OverlapResidual));
  mrpt::rtti::registerClass(CLASS_ID(FreeSpaceConsistency));
  mrpt::rtti::registerClass(CLASS_ID(BothDirections));
  mrpt::rtti::registerClass(CLASS_ID(GuessDeviation));
  mrpt::rtti::registerClass(CLASS_ID(PclFitness));
}

}  // namespace lamp
