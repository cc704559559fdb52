#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/film/film_stage.hpp"
#include "tests/support/film/picture/blur.hpp"
#include "tests/support/film/picture/camera.hpp"

// What a lens does with a place and with a point of light.
namespace astro::support::film {
namespace {

TEST(Camera, ThatTurnedSeesTheFloorMovedByThatManyPixels) {
  const Lens lens = main_lens();
  const Eigen::Vector3d place(0, 0.5, 0);
  const Pixel before = seen_at(lens, on_shelf(), place);
  const Pixel after = seen_at(lens, turned(on_shelf(), 2 / lens.f_px, 0), place);
  EXPECT_NEAR(after.v - before.v, 2, 0.05);  // to the second order of the angle off the axis, and distortion
  EXPECT_NEAR(after.u - before.u, 0, 0.05);
}

TEST(Lens, FindsTheRayOfEachPixelAgain) {
  const Lens strange{1920, 1080, 1700, 971.5, 531.5, 0.08, -0.15, 4e-4, -3e-4, 0.03};
  for (const Lens& lens : {main_lens(), wide_lens(), at_720p(wide_lens()), strange}) {
    for (double u = 0; u < lens.width_px; u += 149) {
      for (double v = 0; v < lens.height_px; v += 97) {
        const Pixel again = seen_at(lens, ray_of(lens, {u, v}));
        EXPECT_NEAR(again.u, u, 1e-7);
        EXPECT_NEAR(again.v, v, 1e-7);
      }
    }
  }
}

TEST(Lens, SeesTheSameAt720pWithTwoThirdsOfThePixels) {
  const Lens large = main_lens(), small = at_720p(large);
  const Ray ray{0.3, -0.2};
  const Pixel a = seen_at(large, ray), b = seen_at(small, ray);
  EXPECT_NEAR((a.u + 0.5) * 2 / 3, b.u + 0.5,
              1e-9);  // edges of pixels, which are half a pixel off their centres
  EXPECT_NEAR((a.v + 0.5) * 2 / 3, b.v + 0.5, 1e-9);
}

TEST(Blur, KeepsTheLightAndSpreadsAPointAsAGaussian) {
  Plane point(Window{0, 0, 41, 41});
  point.row(20)[20] = 1;
  const Plane spread = blurred(point, point.window(), 1.5);
  double sum = 0, squares = 0;
  for (int v = 0; v < 41; ++v) {
    for (int u = 0; u < 41; ++u) {
      sum += static_cast<double>(spread.row(v)[u]);
      squares += static_cast<double>(spread.row(v)[u]) * (u - 20) * (u - 20);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-5);
  EXPECT_NEAR(std::sqrt(squares / sum), 1.5, 0.01);  // its tails end at 3.5 standard deviations
}

TEST(Blur, LeavesEvenLightAsItIsAlsoAtThePicturesEnds) {
  Plane even(Window{0, 0, 30, 20});
  for (int v = 0; v < 20; ++v) std::fill(even.row(v), even.row(v) + 30, 0.5F);
  const Plane same = blurred(even, Window{0, 0, 30, 20}, 2);
  for (int v = 0; v < 20; ++v)
    for (int u = 0; u < 30; ++u) EXPECT_NEAR(same.row(v)[u], 0.5F, 1e-5);
}

}  // namespace
}  // namespace astro::support::film
