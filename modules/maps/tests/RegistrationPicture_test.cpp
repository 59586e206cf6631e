#include "lamp/maps/RegistrationPicture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestMaps.h"
#include "TestPixels.h"

namespace lamp {
namespace {

using mrpt::img::CImage;
using testing::HasSubstr;

constexpr Color kSource{225, 95, 0}, kTarget{20, 95, 190};
constexpr int kLegend_px = 60;

/** A wall that both clouds have, 5 m apart in their frames. */
RegistrationPicture wall() {
  RegistrationPicture picture;
  for (float x = 0; x < 10; x += 0.5f)
    for (float z = 0; z < 3; z += 0.5f) {
      picture.target.points.push_back({x, 0.3f * x, z});
      picture.source.points.push_back({x, 0.3f * x + 5, z});
    }
  return picture;
}

CImage drawn(const RegistrationPicture& picture) {
  const std::string path = freshFolder() + "/pair.png";
  writeRegistrationPicture(path, picture);
  CImage image;
  EXPECT_TRUE(image.loadFromFile(path));
  return image;
}

/** Pixels of one ink alone above the legend, in a range of columns. */
size_t count(const CImage& image, Color ink, size_t begin, size_t end) {
  size_t n = 0;
  for (int y = 0; y < static_cast<int>(image.getHeight()) - kLegend_px; ++y)
    for (size_t x = begin; x < end; ++x) n += inked(pixelAt(image, static_cast<int>(x), y), ink);
  return n;
}

TEST(RegistrationPicture, CloudsThatAgreeCoverOneAnother) {
  RegistrationPicture picture = wall();
  picture.target_T_source = Pose3(Eigen::Translation3d(0, -5, 0));
  const CImage image = drawn(picture);
  const size_t width = image.getWidth();
  for (const Color ink : {kSource, kTarget}) {
    const size_t before = count(image, ink, 0, width / 2);
    EXPECT_GT(before, 200u);
    EXPECT_LT(count(image, ink, width / 2, width), before / 2)
        << "the rings of the two origins remain";
  }
}

TEST(RegistrationPicture, CloudsThatDisagreeAreSeenApart) {
  RegistrationPicture picture = wall();
  picture.target_T_source = Pose3(Eigen::Translation3d(0, -2, 0));
  const CImage image = drawn(picture);
  for (const Color ink : {kSource, kTarget})
    EXPECT_GT(count(image, ink, image.getWidth() / 2, image.getWidth()), 200u);
}

TEST(RegistrationPicture, WithoutAPoseThereIsNoAfter) {
  RegistrationPicture picture = wall();
  const CImage before = drawn(picture);
  picture.target_T_source = Pose3::Identity();
  EXPECT_LT(before.getWidth(), drawn(picture).getWidth());
}

TEST(RegistrationPicture, OnePointIsEnough) {
  RegistrationPicture picture;
  picture.source.points = picture.target.points = {{1, 2, 3}};
  EXPECT_GT(drawn(picture).getWidth(), 100u);
}

TEST(RegistrationPicture, FailuresNameThePath) {
  const std::string path = freshFolder() + "/missing/pair.png";
  EXPECT_THAT(errorOf([&] { writeRegistrationPicture(path, wall()); }), HasSubstr(path));
}

}  // namespace
}  // namespace lamp
