#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/film/picture/corner_refinement.hpp"

namespace astro::film {
namespace {

using Eigen::Vector2d;

double blurred_step(double distance_px, double blur_px) {
  return 0.5 * std::erfc(-distance_px / (std::sqrt(2.0) * blur_px));
}

/// A black quadrangle with corners `corners` on white, through a lens that blurs and the tone curve of sRGB.
GrayFrame picture_of(const TagCorners& corners, double blur_px) {
  constexpr double kBlack = 0.03, kWhite = 0.7;  // in linear light
  GrayFrame frame{160, 120, {}, 0, true};
  frame.pixels.resize(160 * 120);
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      double inside = 1;
      for (std::size_t i = 0; i < 4; ++i) {
        const Vector2d edge = (corners[(i + 1) % 4] - corners[i]).normalized();
        const Vector2d inward(edge.y(), -edge.x());
        inside *= blurred_step(inward.dot(Vector2d(x, y) - corners[i]), blur_px);
      }
      const auto light = static_cast<float>(kWhite + (kBlack - kWhite) * inside);
      const auto& table = linear_light();
      const auto above = std::lower_bound(table.begin(), table.end(), light);
      frame.pixels[static_cast<std::size_t>(y * frame.width + x)] =
          static_cast<std::uint8_t>(above - table.begin());
    }
  return frame;
}

TEST(CornerRefinement, FindsCornersToSomeHundredthsOfAPixel) {
  const TagCorners corners{Vector2d(40.3, 88.7), {101.6, 92.2}, {105.4, 33.1}, {43.9, 28.4}};
  TagCorners start = corners;
  start[0] += Vector2d(0.9, -0.7);
  start[2] += Vector2d(-0.6, 1.1);
  for (const double blur_px : {0.7, 1.0}) {
    const auto found = refine_corners(picture_of(corners, blur_px), start);
    ASSERT_TRUE(found);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT((found->corners[i] - corners[i]).norm(), 0.04);  // 8 bits, one picture
    EXPECT_NEAR(found->edge_width_px, blur_px, 0.3);
    EXPECT_NEAR(found->contrast, 0.67, 0.05);
  }
}

TEST(CornerRefinement, FindsNothingWhereThereIsNoTag) {
  GrayFrame gray{160, 120, std::vector<std::uint8_t>(160 * 120, 128), 0, true};
  EXPECT_FALSE(refine_corners(gray, {Vector2d(40, 88), {101, 92}, {105, 33}, {43, 28}}));
}

TEST(CornerRefinement, GivesUpAtThePicturesRim) {
  const TagCorners corners{Vector2d(1.0, 88.7), {61.6, 92.2}, {65.4, 33.1}, {0.9, 28.4}};
  EXPECT_FALSE(refine_corners(picture_of(corners, 0.8), corners));
}

}  // namespace
}  // namespace astro::film
