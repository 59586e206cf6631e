#pragma once

#include <string>
#include <vector>

#include "g2o/G2oLines.h"
#include "lamp/core/G2oFile.h"

namespace lamp {

/** The edges of a file that have any information. \param notes gets a sentence if others are left
 * out, one if edges repeat others, and one if information was mended. */
std::vector<const G2oLine*> telling(const G2oLines& file, std::vector<std::string>& notes);

/** Of the relative poses among the edges. */
InformationKind informationKind(const std::vector<const G2oLine*>& edges);

}  // namespace lamp
