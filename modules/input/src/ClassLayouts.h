#pragma once

#include <map>
#include <string_view>

namespace lamp {

class LayoutCursor;

/** What MRPT writes for a class, after its version. */
struct ClassLayout {
  void (*follow)(LayoutCursor& in, int version) = nullptr;
  int oldest = 0;  ///< versions that are read
  int newest = 0;
};

/** By full class name. The formats are those that the functions serializeFrom() of MRPT 2.5.8 read,
 * those of earlier releases among them. */
using ClassLayouts = std::map<std::string_view, ClassLayout>;

/** Classes that stand in rawlogs by themselves. */
const ClassLayouts& recordedLayouts();
/** Classes that are parts of others. */
const ClassLayouts& partLayouts();

namespace classes {
constexpr char kPose2D[] = "mrpt::poses::CPose2D";
constexpr char kPose3D[] = "mrpt::poses::CPose3D";
constexpr char kPoint3D[] = "mrpt::poses::CPoint3D";
constexpr char kPose3DGaussian[] = "mrpt::poses::CPose3DPDFGaussian";
constexpr char kPoseGaussian[] = "mrpt::poses::CPosePDFGaussian";
constexpr char kPoseParticles[] = "mrpt::poses::CPosePDFParticles";
constexpr char kMatrixF[] = "mrpt::math::CMatrixF";
constexpr char kMatrixD[] = "mrpt::math::CMatrixD";
constexpr char kCamera[] = "mrpt::img::TCamera";
constexpr char kPicture[] = "mrpt::img::CImage";
constexpr char kMapParameters[] = "mrpt::maps::TMapGenericParams";
constexpr char kSimplePoints[] = "mrpt::maps::CSimplePointsMap";
constexpr char kPointsXYZI[] = "mrpt::maps::CPointsMapXYZI";
constexpr char kColouredPoints[] = "mrpt::maps::CColouredPointsMap";
constexpr char kWeightedPoints[] = "mrpt::maps::CWeightedPointsMap";
}  // namespace classes

}  // namespace lamp
