#pragma once

#include <string>
#include <vector>

#include "lamp/maps/MapExporter.h"

namespace lamp {

/** `<stem>.simplemap`: a mrpt::maps::CSimpleMap, from which MRPT's and MOLA's tools build metric
 * maps of any kind. A key node is a pose, as a CPose3DPDFGaussian whose covariance is zero, that is
 * not given, and its keyed scan, a CObservationPointCloud a sensor. Frame of the map, metres; the
 * format has no place for its offset from the world. */
class SimpleMap : public MapExporter {
  DEFINE_MRPT_OBJECT(SimpleMap, lamp)

 public:
  void visit(OptionVisitor&) override {}
  std::vector<std::string> exportMap(const ComponentMap& map, const std::string& stem) override;
};

}  // namespace lamp
