#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** Makes an information matrix positive semi-definite if it is indefinite by no more than what
 * rounding its entries to five digits can do: an eigenvalue that was zero, or nearly, is below it
 * then. Others stay as they are. \return whether it did. */
bool mendRounding(Matrix6d& information);

}  // namespace lamp
