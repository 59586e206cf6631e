#include <stdexcept>

#include "ClassLayouts.h"
#include "LayoutCursor.h"

namespace lamp {
namespace {

using namespace classes;

constexpr size_t kFloat = 4, kDouble = 8;
constexpr int kPictureWithoutOpenCv = 100;  ///< a version that MRPT without OpenCV writes

void pose2D(LayoutCursor& in, int version) {
  in.array(3, version == 0 ? kFloat : kDouble);
}
void pose3D(LayoutCursor& in, int version) {
  if (version == 0) return in.part({kMatrixF});
  if (version == 1) return in.part({kMatrixD});
  in.array(version == 2 ? 7 : 12, kDouble);
}
void point3D(LayoutCursor& in, int version) {
  in.array(3, version == 0 ? kFloat : kDouble);
}

void pose3DGaussian(LayoutCursor& in, int) {
  in.part({kPose3D});
  in.array(21, kDouble);
}
void poseGaussian(LayoutCursor& in, int version) {
  in.part({kPose2D});
  if (version == 0) return in.part({kMatrixF});
  in.array(6, version == 1 ? kFloat : kDouble);
}
void poseParticles(LayoutCursor& in, int version) {
  const uint32_t particles = in.number();
  if (version > 0) return in.array(particles, 4 * kDouble);
  for (uint32_t i = 0; i < particles; ++i) {
    in.skip(kDouble);
    in.part({kPose2D});
  }
}

template <size_t kElement>
void matrix(LayoutCursor& in, int) {
  const uint32_t rows = in.number();
  in.grid(rows, in.number(), kElement);
}

void camera(LayoutCursor& in, int version) {
  in.array(1 + (version < 3 ? 5 : 8), kDouble);
  if (version < 4) {
    in.part({kMatrixD});
  } else {
    in.array(4, kDouble);
  }
  if (version == 0) in.part({kMatrixD});
  if (version >= 2) in.skip(8);
  if (version >= 5) in.text();
  if (version >= 6) in.skip(1);
}

void grayPicture(LayoutCursor& in, int version) {
  in.skip(12);
  const uint32_t size = in.number();
  if (version >= 9) in.skip(4);
  const bool zipped = version >= 5 ? in.flag() : version == 3 || (version == 4 && size > 16 * 1024);
  in.skip(zipped ? in.number() : size);
}
void colourPicture(LayoutCursor& in, int version) {
  if (version >= 7) {
    const auto width = static_cast<int32_t>(in.number());
    const auto height = static_cast<int32_t>(in.number());
    if (width < 0 && height < 0) {
      return in.grid(static_cast<uint64_t>(-int64_t{width}),
                     static_cast<uint64_t>(-int64_t{height}), 3);
    }
    if (width < 1 || height < 1) return;
  }
  in.list(1);
}
void picture(LayoutCursor& in, int version) {
  if (version == 0) {
    in.skip(13);
    return in.list(1);
  }
  if (version == 1) return in.list(1);
  if (version >= 6 && in.flag()) return in.text();
  if (version == kPictureWithoutOpenCv) return;
  if (version > 9) throw std::runtime_error("a version that is not known");
  in.flag() ? colourPicture(in, version) : grayPicture(in, version);
}

void mapParameters(LayoutCursor& in, int) {
  in.skip(3);
}

enum class Options { kWithRendering, kWithoutRendering };

void mapOptions(LayoutCursor& in, Options options) {
  const auto requireVersion0 = [&] {
    if (in.byte() != 0) throw std::runtime_error("a version that is not known");
  };
  requireVersion0();
  in.skip(kFloat + 5 + 2 * kFloat + 1);
  requireVersion0();
  in.skip(2 * kDouble + 4);
  if (options == Options::kWithoutRendering) return;
  requireVersion0();
  in.skip(5 * kFloat + 1);
}

void simplePoints(LayoutCursor& in, int version) {
  in.list(3 * kFloat);
  in.part({kMapParameters});
  mapOptions(in, version >= 10 ? Options::kWithRendering : Options::kWithoutRendering);
}
void pointsXYZI(LayoutCursor& in, int) {
  in.list(4 * kFloat);
  mapOptions(in, Options::kWithoutRendering);
}
void colouredPoints(LayoutCursor& in, int) {
  in.list(3 * kFloat);
  for (int channel = 0; channel < 3; ++channel) in.list(kFloat);
  in.part({kMapParameters});
  mapOptions(in, Options::kWithoutRendering);
}
void weightedPoints(LayoutCursor& in, int) {
  in.list(4 * kFloat);
  in.part({kMapParameters});
  mapOptions(in, Options::kWithoutRendering);
}

}  // namespace

const ClassLayouts& partLayouts() {
  static const ClassLayouts layouts{{kPose2D, {pose2D, 0, 1}},
                                    {kPose3D, {pose3D, 0, 3}},
                                    {kPoint3D, {point3D, 0, 1}},
                                    {kPose3DGaussian, {pose3DGaussian, 1, 1}},
                                    {kPoseGaussian, {poseGaussian, 0, 2}},
                                    {kPoseParticles, {poseParticles, 0, 1}},
                                    {kMatrixF, {matrix<kFloat>, 0, 0}},
                                    {kMatrixD, {matrix<kDouble>, 0, 0}},
                                    {kCamera, {camera, 0, 6}},
                                    {kPicture, {picture, 0, kPictureWithoutOpenCv}},
                                    {kMapParameters, {mapParameters, 0, 0}},
                                    {kSimplePoints, {simplePoints, 9, 10}},
                                    {kPointsXYZI, {pointsXYZI, 0, 0}},
                                    {kColouredPoints, {colouredPoints, 9, 9}},
                                    {kWeightedPoints, {weightedPoints, 2, 2}}};
  return layouts;
}

}  // namespace lamp
