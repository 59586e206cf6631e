#pragma once

#include "lamp/core/Geometry.h"

namespace lamp {

/** The part of a motion, in a pose's tangent space, in the directions of which an information
 * matrix knows something. If two results only differ by a slide along a tunnel, nothing is
 * left. */
Vector6d observedPart(const Vector6d& motion, const Matrix6d& information);

}  // namespace lamp
