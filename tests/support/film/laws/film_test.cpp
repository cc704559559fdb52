#include "tests/support/film/film.hpp"

#include <gmock/gmock.h>

#include <cstdio>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/film/film_stage.hpp"
#include "tests/support/tags/read_tags.hpp"

// Whole films: through ffmpeg and back, and the drives in them.
namespace astro::support::film {
namespace {

namespace fs = std::filesystem;

std::string output_of(const std::string& command) {
  std::FILE* const pipe = popen(command.c_str(), "r");
  std::string all;
  char part[1 << 16];
  for (std::size_t size = 0; (size = std::fread(part, 1, sizeof part, pipe)) > 0;) all.append(part, size);
  pclose(pipe);
  return all;
}

bool without_ffmpeg() { return output_of("command -v ffmpeg ffprobe").empty(); }

std::vector<double> stamps_of(const fs::path& mp4) {
  std::istringstream lines(output_of(
      "ffprobe -v error -select_streams v -show_entries frame=best_effort_timestamp_time -of csv=p=0 '" +
      mp4.string() + "'"));
  std::vector<double> stamps;
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) stamps.push_back(std::stod(line));
  return stamps;
}

/// A second of a robot that drives, in a small picture.
FilmSetup short_film() {
  std::vector<FloorPose> poses;
  for (int i = 0; i <= 1200; ++i) poses.push_back({0.0004 * i - 0.2, 0.3, 0.2});
  FilmSetup setup;
  setup.scene.robots.push_back(filmed(PoseTrack(0, 1e-3, poses)));
  setup.scene.floor = tags_around(false);
  setup.lens = at_720p(main_lens());
  setup.camera = [](double) { return on_shelf(); };
  setup.begin_s = 0.1;
  setup.end_s = 1.1;
  return setup;
}

class Film : public testing::Test {
 protected:
  void SetUp() override {
    if (without_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  }
  fs::path mp4() const { return folder_.path() / "film.mp4"; }
  test::TemporaryFolder folder_;
};

TEST_F(Film, HasTheStampsThatItWasGiven) {
  for (const double mbit_per_s : {0.0, 2.0}) {
    FilmSetup setup = short_film();
    setup.clock = {.fps = 30, .jitter_s = 0.003, .stamp_s = 0.001, .lost = 0.1, .seed = 9};
    setup.codec.mbit_per_s = mbit_per_s;
    const auto truth = make_film(setup, mp4());
    const auto stamps = stamps_of(mp4());
    ASSERT_EQ(stamps.size(), truth.size());
    // Stamps in the file are in units of 11 us, and ffprobe prints whole microseconds.
    for (std::size_t i = 0; i < stamps.size(); ++i) EXPECT_NEAR(stamps[i], truth[i].time.pts_s, 7e-6);
  }
}

TEST_F(Film, IsReadByLibapriltagAfterTheCodec) {
  FilmSetup setup = short_film();
  setup.end_s = 0.4;
  setup.codec.mbit_per_s = 4;
  const auto truth = make_film(setup, mp4());
  const std::string pictures =
      output_of("ffmpeg -v error -i '" + mp4().string() + "' -f rawvideo -pix_fmt gray pipe:1");
  const std::size_t size = 1280 * 720;
  ASSERT_EQ(pictures.size(), truth.size() * size);
  for (std::size_t frame = 0; frame < truth.size(); ++frame) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(pictures.data()) + frame * size;
    std::set<int> ids;
    for (const ReadTag& tag : read_tags({first, size}, 1280, 720)) {
      ids.insert(tag.id);
      if (tag.id != 0) continue;
      double row = 0;
      for (const PicturePoint& corner : tag.corners) row += corner.y_px / 4;
      EXPECT_NEAR(row, truth[frame].row, 1);  // corners' mean against the centre: perspective
    }
    EXPECT_THAT(ids, testing::ElementsAre(0, 1, 2, 3, 4, 5, 6)) << "frame " << frame;
  }
}

TEST_F(Film, WithoutLossIsTheRenderedPicture) {
  FilmSetup setup = short_film();
  setup.end_s = 0.2;
  setup.codec.mbit_per_s = 0;
  make_film(setup, mp4());
  const std::string pictures =
      output_of("ffmpeg -v error -i '" + mp4().string() + "' -f rawvideo -pix_fmt yuv420p pipe:1");
  Renderer renderer(setup.scene, setup.lens, setup.blur_px, setup.sensor, setup.seed);
  std::vector<std::uint8_t> picture(1280 * 720);
  renderer.render(setup.camera(0), setup.shutter, setup.begin_s, picture.data());
  EXPECT_TRUE(
      std::equal(picture.begin(), picture.end(), reinterpret_cast<const std::uint8_t*>(pictures.data())));
}

TEST(TrueFrames, HaveTheTagsRowAndItsTime) {
  const FilmSetup setup = short_film();
  const TrueFrame frame = true_frame(setup, {0.5, 0.4});
  const FilmedRobot& robot = setup.scene.robots[0];
  EXPECT_NEAR(frame.row_s, 0.5 + frame.row / 720 * setup.shutter.readout_s, 1e-12);
  EXPECT_NEAR(frame.at_row.x_m - frame.at_first_row.x_m, 0.4 * (frame.row_s - 0.5), 1e-9);
  EXPECT_NEAR(seen_at(setup.lens, on_shelf(), {frame.at_row.x_m, frame.at_row.y_m, robot.height_m}).v,
              frame.row, 1e-9);
}

}  // namespace
}  // namespace astro::support::film
