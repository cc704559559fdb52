#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "host/base/error.hpp"
#include "tests/host/film/track/recorded_film.hpp"

/// The whole way on a film whose truth is known.
namespace astro::film {
namespace {

TEST(RecordedFilm, ShowsPosesToAQuarterOfAMillimetre) {
  if (support::recorded_film().empty()) GTEST_SKIP() << "the film is not beside this checkout";
  const FilmTrack track = follow_film(support::recorded_film(), support::stated_figures());
  const std::vector<support::TrueFrame> frames = support::true_frames();
  const support::PoseErrors errors = support::compare(track.found.poses, frames);
  std::cout << "position " << 1e3 * errors.position_m << " mm, heading " << 1e3 * errors.heading_rad
            << " mrad, scale " << errors.scale << " +- " << track.scale_sigma << ", " << errors.compared
            << " of " << frames.size() << " pictures, corners " << track.found.corner_px << " px\n";
  EXPECT_LE(errors.position_m, 0.25e-3);
  EXPECT_LE(errors.heading_rad, 2.5e-3);
  EXPECT_LE(std::abs(errors.scale), 1e-3);
  EXPECT_GE(errors.compared, frames.size() * 98 / 100) << "the robot is seen all the time";
  EXPECT_TRUE(track.remarks.empty());
}

}  // namespace
}  // namespace astro::film
