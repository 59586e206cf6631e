#pragma once

#include <string>
#include <vector>

#include "g2o/G2oLines.h"
#include "lamp/core/G2oFile.h"

namespace lamp {

/** The edges of a file that have any information, those that repeat another one word for word but
 * once: they are one measurement, and no second witness. \param notes gets a sentence for each kind
 * that is left out, and one if information was mended. */
std::vector<const G2oLine*> telling(const G2oLines& file, std::vector<std::string>& notes);

/** Of the relative poses among the edges. */
InformationKind informationKind(const std::vector<const G2oLine*>& edges);

}  // namespace lamp
