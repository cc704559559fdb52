#include "tests/support/film/film_set.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "tests/support/film/film_stage.hpp"
#include "tests/support/tags/read_tags.hpp"

// The films by which an estimator is judged are what their names say.
namespace astro::support::film {
namespace {

class FilmSet : public testing::TestWithParam<std::string> {};
std::vector<std::string> all_names() {
  std::vector<std::string> names = good_film_names();
  for (const std::string& name : wrong_film_names()) names.push_back(name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, FilmSet, testing::ValuesIn(all_names()), [](const auto& name) {
  std::string word = name.param;
  std::erase(word, '-');
  return word;
});

bool in_picture(const Pixel& at, const Lens& lens) {
  constexpr double kEdge_px = 4;
  return at.u > kEdge_px && at.v > kEdge_px && at.u < lens.width_px - kEdge_px &&
         at.v < lens.height_px - kEdge_px;
}

TEST_P(FilmSet, HasAllTagsInThePictureUnlessThatIsItsFlaw) {
  if (GetParam() == "out-of-picture") return;
  const FilmCase film = film_case(GetParam());
  const FilmSetup& setup = film.setup;
  for (const FloorTag& tag : setup.scene.floor)
    for (const Eigen::Vector3d& corner : tag.patch().corners_m())
      EXPECT_TRUE(in_picture(seen_at(setup.lens, setup.camera(0), corner), setup.lens)) << tag.paper.id();
  for (double time_s = setup.begin_s; time_s < setup.end_s; time_s += 0.1)
    for (const Eigen::Vector3d& corner : setup.scene.robots[0].tag_patch_at(time_s).corners_m())
      ASSERT_TRUE(in_picture(seen_at(setup.lens, setup.camera(0), corner), setup.lens)) << time_s;
}

/// Of the first picture, which is not encoded.
std::multiset<int> ids_at_begin_of(const std::string& name) {
  const FilmSetup setup = film_case(name).setup;
  const int width = setup.lens.width_px, height = setup.lens.height_px;
  std::vector<std::uint8_t> picture(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  Renderer renderer(setup.scene, setup.lens, setup.blur_px, setup.sensor, setup.seed);
  renderer.render(setup.camera(0), setup.shutter, setup.begin_s, picture.data());
  std::multiset<int> ids;
  for (const ReadTag& tag : read_tags(picture, width, height)) ids.insert(tag.id);
  return ids;
}

TEST(GoodFilm, ShowsLibapriltagTheRobotsTagAndSixOnTheFloor) {
  for (const std::string& name : good_film_names())
    EXPECT_THAT(ids_at_begin_of(name), testing::ElementsAre(0, 1, 2, 3, 4, 5, 6)) << name;
}

TEST(WrongFilm, ShowsLibapriltagItsFlaw) {
  EXPECT_THAT(ids_at_begin_of("mirrored-print"), testing::IsEmpty());
  EXPECT_THAT(ids_at_begin_of("two-robots"), testing::ElementsAre(0, 0, 1, 2, 3, 4, 5, 6));
  EXPECT_EQ(ids_at_begin_of("blurred").count(0), 0U);
}

TEST(WrongFilm, OutOfPictureLosesTheRobotInTheMiddleOfTheDrive) {
  const FilmCase film = film_case("out-of-picture");
  const FilmSetup& setup = film.setup;
  const auto seen = [&](double time_s) {
    const FloorPose tag = setup.scene.robots[0].tag_at(time_s);
    return in_picture(seen_at(setup.lens, setup.camera(0), {tag.x_m, tag.y_m, 0.12}), setup.lens);
  };
  EXPECT_TRUE(seen(setup.begin_s));
  EXPECT_FALSE(seen(setup.end_s));
}

TEST_P(FilmSet, RecordsTheRunsThatItShows) {
  const FilmCase film = film_case(GetParam());
  for (const recording::Run& run : film.drives.runs) {
    EXPECT_NE(run.odometry.back().left_counts, run.odometry.front().left_counts);
    for (const recording::TruthSample& sample : run.truth) {
      const FloorPose shown = film.drives.track.at(static_cast<double>(sample.time_us) * 1e-6);
      EXPECT_NEAR(shown.x_m, sample.x_m, 1e-9);
      EXPECT_NEAR(shown.theta_rad, sample.theta_rad, 1e-9);
    }
  }
}

TEST(FilmedDrives, GoOnFromWhereTheRobotStands) {
  const FilmedDrives drives = film_drives(
      uncalibrated_robot(1), {1, 2, 0.5},
      {free_wish("a", robot::line(0.3, {0.4, 1.5})), free_wish("b", robot::line(0.3, {0.4, 1.5}))}, 1);
  EXPECT_NEAR(drives.track.at(0).x_m, 1, 1e-9);
  const FloorPose end = drives.track.at(drives.track.end_s());
  // 0.6 m by wheels that are off by less than a per cent.
  EXPECT_NEAR(std::hypot(end.x_m - 1, end.y_m - 2), 0.6, 0.006);
  EXPECT_LT(drives.runs[0].truth.back().time_us, drives.runs[1].truth.front().time_us);
}

}  // namespace
}  // namespace astro::support::film
