#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "host/base/file_problem.hpp"
#include "host/film/picture/detector.hpp"
#include "host/film/picture/film_info.hpp"
#include "host/film/picture/film_program.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/temporary_folder.hpp"

// What is no film, or one that cannot be followed: refused in time, with one sentence.
namespace astro::film {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using support::ThrowsTelling;

class NoFilm : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v ffmpeg ffprobe > /dev/null") != 0) GTEST_SKIP() << "ffmpeg is not installed";
  }
  /// A film of two pictures that is called `name`.
  fs::path film(const std::string& name, const std::string& size, const std::string& options) const {
    const fs::path file = folder_.path() / name;
    const std::string command = "ffmpeg -loglevel error -y -f lavfi -i color=gray:size=" + size +
                                ":rate=10:duration=0.2 " + options + " '" + file.string() + "'";
    if (std::system(command.c_str()) != 0) ADD_FAILURE() << command;
    return file;
  }
  test::TemporaryFolder folder_;
};

TEST_F(NoFilm, IsAPlaylistThatNamesAFilm) {
  const fs::path good = film("good.mp4", "128x128", "-pix_fmt yuv420p");
  EXPECT_EQ(read_film_info(good).width, 128);
  film("hls.m3u8", "128x128", "-pix_fmt yuv420p -f hls");
  fs::rename(folder_.path() / "hls.m3u8", folder_.path() / "hls.mp4");
  std::ofstream(folder_.path() / "list.mp4") << "ffconcat version 1.0\nfile good.mp4\n";
  for (const char* name : {"hls.mp4", "list.mp4"})
    EXPECT_THAT([&] { read_film_info(folder_.path() / name); },
                ThrowsTelling(FilmFileProblem::not_a_film, (folder_.path() / name).string()));
}

TEST_F(NoFilm, IsReadThroughAPlaylistThatNamesAPipe) {
  const fs::path pipe = folder_.path() / "pipe.ts";
  ASSERT_EQ(std::system(("mkfifo '" + pipe.string() + "'").c_str()), 0);
  std::ofstream(folder_.path() / "list.mp4") << "ffconcat version 1.0\nfile pipe.ts\n";
  const fs::path list = folder_.path() / "list.mp4";
  EXPECT_THAT([&] { read_film_info(list); }, ThrowsTelling(FilmFileProblem::not_a_film, list.string()));
  EXPECT_THAT([&] { read_film_info(pipe); }, ThrowsTelling(FileProblem::is_device_or_pipe, pipe.string()));
}

TEST_F(NoFilm, HasLargerPicturesThanAnyPhoneTakes) {
  for (const auto& [width, height] : {std::pair{"16384", "64"}, {"64", "16384"}}) {
    const std::string size = std::string(width) + "x" + height;
    const fs::path large = film(size + ".mkv", size, "-c:v ffv1");
    // Where no tag is seen, a picture is looked at in twice its size.
    EXPECT_THAT([&] { read_film_info(large); },
                ThrowsTelling(FilmFileProblem::unusual_size, large.string(), width, height));
  }
  EXPECT_EQ(read_film_info(film("8k.mkv", "8192x64", "-c:v ffv1")).width, 8192);
}

TEST_F(NoFilm, IsOfAContainerThatPhonesWrite) {
  for (const char* name : {"a.mov", "a.mkv", "a.avi"})
    EXPECT_EQ(read_film_info(film(name, "128x128", "-pix_fmt yuv420p")).height, 128) << name;
}

TEST(FilmProgram, ThatNeitherWritesNorEndsIsEnded) {
  const auto begin = std::chrono::steady_clock::now();
  const auto silent = [](const std::string& script, auto work) {
    FilmProgram child(
        {"sh", "-c", script}, [](std::string_view) {}, milliseconds(100));
    work(child);
  };
  std::uint8_t byte[1];
  EXPECT_THAT([&] { silent("exec sleep 100", [&](FilmProgram& child) { child.read(byte); }); },
              ThrowsTelling(FilmProgramProblem::silent, "sh", "100"));
  EXPECT_THAT([&] { silent("exec >&-; exec sleep 100", [](FilmProgram& child) { child.finish(); }); },
              ThrowsTelling(FilmProgramProblem::silent, "sh", "100"));
  silent("exec >&- 2>&-; exec sleep 100", [](FilmProgram& child) { EXPECT_FALSE(child.finish()); });
  silent("echo a; exec sleep 100", [&](FilmProgram& child) { EXPECT_EQ(child.read(byte), 1U); });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

GrayFrame checkered(int width, int height) {
  GrayFrame frame{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height))};
  for (std::size_t i = 0; i < frame.pixels.size(); ++i)
    frame.pixels[i] = i * 2654435761U >> 28U & 1U ? 255 : 0;
  return frame;
}

TEST(TagDetector, FindsNothingInAWindowThatIsSmallerThanATag) {
  TagDetector detector;
  for (const double decimate : {1.0, 2.0})
    for (const Window window :
         {Window{0, 0, 1, 1}, {0, 0, 3, 3}, {0, 0, 4, 4}, {0, 0, 100, 2}, {0, 0, 2, 100}, {0, 0, 7, 100}})
      EXPECT_TRUE(detector.detect(checkered(100, 100), window, decimate).empty());
}

TEST(TagDetector, RefusesAPictureInWhichItCannotCount) {
  TagDetector detector;
  for (const auto& [width, height] : {std::pair{32'768, 16}, {16, 32'768}}) {
    const GrayFrame frame = checkered(width, height);
    EXPECT_THAT(
        [&] { detector.detect(frame, whole_of(frame), 1); },
        ThrowsTelling(DetectorProblem::picture_too_large, std::to_string(width), std::to_string(height)));
  }
}

}  // namespace
}  // namespace astro::film
