#include <mrpt/core/initializer.h>

#include "MostUncertain.h"
#include "SameHeading.h"
#include "TrimmedLm.h"

using namespace lamp;

/** Runs when the library is loaded. */
MRPT_INITIALIZER(registerLampExamples) {
  mrpt::rtti::registerClass(CLASS_ID(SameHeading));
  mrpt::rtti::registerClass(CLASS_ID(MostUncertain));
  mrpt::rtti::registerClass(CLASS_ID(TrimmedLm));
}
