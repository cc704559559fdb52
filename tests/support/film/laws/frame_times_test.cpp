#include "tests/support/film/frame_times.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace astro::support::film {
namespace {

TEST(FrameTimes, OfAPerfectPhoneAreEven) {
  const auto frames = frame_times({.fps = 30, .skew = 0, .jitter_s = 0, .stamp_s = 0, .lost = 0}, 5, 7);
  ASSERT_EQ(frames.size(), 60U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_NEAR(frames[i].robot_s, 5 + static_cast<double>(i) / 30, 1e-12);
    EXPECT_NEAR(frames[i].pts_s, static_cast<double>(i) / 30, 5e-7);  // whole microseconds
  }
}

TEST(FrameTimes, AreUnevenStayInOrderAndKeepToTheClock) {
  const FilmClock clock{
      .fps = 60, .skew = 1e-3, .jitter_s = 0.003, .stamp_s = 0.0002, .lost = 0.1, .seed = 4};
  const auto frames = frame_times(clock, 2, 62);
  EXPECT_NEAR(static_cast<double>(frames.size()), 60 * 60 * 0.9, 5 * std::sqrt(3600 * 0.1 * 0.9));
  double squares = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    EXPECT_GT(frames[i].robot_s, frames[i - 1].robot_s);
    EXPECT_GT(frames[i].pts_s, frames[i - 1].pts_s);
    squares += std::pow(2 + (1 + clock.skew) * frames[i].pts_s - frames[i].robot_s, 2);
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(frames.size())), clock.stamp_s, 0.05 * clock.stamp_s);
}

TEST(FrameTimes, OfACutFilmJumpByWhatWasCutOut) {
  const FilmClock clock{.skew = 0, .jitter_s = 0, .stamp_s = 0, .lost = 0};
  const auto whole = frame_times(clock, 0, 10), closed = frame_times(clock, 0, 10, Cut{4, 6}),
             open = frame_times(clock, 0, 10, Cut{4, 6, false});
  EXPECT_EQ(closed.size() + 60, whole.size());
  EXPECT_EQ(open.size(), closed.size());
  EXPECT_NEAR(closed.back().robot_s - closed.back().pts_s, 2, 1e-6);
  EXPECT_NEAR(open.back().robot_s - open.back().pts_s, 0, 1e-6);
}

}  // namespace
}  // namespace astro::support::film
