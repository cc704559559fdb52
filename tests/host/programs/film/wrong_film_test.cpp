#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/base/thorough.hpp"
#include "tests/support/film/film_set.hpp"
#include "tests/support/programs/program.hpp"

// Each way in which a film can be wrong ends in one sentence that says what to film differently, and in nothing written.
namespace astro {
namespace {

using support::Outcome;
using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

struct Sentence {
  const char* fact;
  const char* remedy;
};

const std::map<std::string, Sentence>& sentences() {
  static const std::map<std::string, Sentence> all{
      {"blurred", {"the tag is blurred", "lock the focus on the floor"}},
      {"cut-film", {"the film is cut: the robot jumps at", "film everything in one go"}},
      {"ends-too-early", {"'drive-1': the film ends", "end it two seconds after the last"}},
      {"mirrored-print", {"is a mirror image", "print the tags as they are"}},
      {"moved-camera", {"the camera was moved", "on a shelf or a tripod"}},
      {"out-of-picture", {"out of the picture", "stays in the picture all the time"}},
      {"stabilised", {"stabilisation moves the picture", "switch stabilisation off"}},
      {"tag-too-small", {"the robot's tag is too small in the picture", "print larger tags"}},
      {"two-robots", {"is at two places at", "film with one robot"}},
  };
  return all;
}

struct WrongWords {
  std::vector<std::string> words;
  const char* fact;
};

class WrongFilm : public testing::TestWithParam<std::string> {};

TEST_P(WrongFilm, IsRefusedWithWhatToFilmDifferently) {
  const std::set<std::string> rendered_quickly{"ends-too-early", "mirrored-print", "moved-camera"};
  if (!support::thorough() && !rendered_quickly.contains(GetParam()))
    GTEST_SKIP() << support::kLeftToThorough;
  const Sentence& sentence = sentences().at(GetParam());
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path(), film = folder / "film.mp4", factors = folder / "factors.toml";
  support::film::film_case(GetParam()).write(folder);
  const Outcome outcome = support::astrolabe({"calibrate", "runs", (folder / "runs").string(), "--truth",
                                              "film:" + film.string(), "--out", factors.string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(sentence.fact), HasSubstr(sentence.remedy)));
  EXPECT_FALSE(fs::exists(factors));
}

// Where nobody says when the robot's runs are, only a robot that drives out of the picture is known to be wrong.
TEST(WrongFilmAlone, ShowsThatTheRobotDrivesOutOfThePicture) {
  const test::TemporaryFolder folder;
  support::film::film_case("out-of-picture").write(folder.path());
  const Outcome outcome = support::astrolabe({"truth", "film", (folder.path() / "film.mp4").string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("the robot drives out of the picture at"));
  EXPECT_THAT(outcome.out, HasSubstr("is out of the picture from"));
}

// A film that is good, and figures that are not.
TEST(WrongFigures, AreNamedWithWhatTheFilmShows) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  const test::TemporaryFolder folder;
  support::film::film_case("ends-too-early").write(folder.path());
  const std::string film = (folder.path() / "film.mp4").string();
  const std::vector<WrongWords> all{
      {{"--tape", "1:99=3.4"}, "floor tag 99, to which a distance is given, is not seen, but 1, 2"},
      {{"--tape", "0:1=3.4"}, "a distance is given to tag 0, which is the robot's: correct --tape 0:1"},
      {{"--tag-side", "0.12", "--floor-tag-side", "0.16", "--tag-height", "0.121", "--tape", "1:4=0.346"},
       "the distance from floor tag 1 to 4 is 3."}};
  for (const WrongWords& wrong : all) {
    std::vector<std::string> words{"truth", "film", film};
    words.insert(words.end(), wrong.words.begin(), wrong.words.end());
    const Outcome outcome = support::astrolabe(words);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr(wrong.fact));
  }
  // Its only key picture does not show that another tag moves.
  const Outcome of_floor = support::astrolabe({"truth", "film", film, "--robot-tag", "3"});
  EXPECT_THAT(of_floor.out, HasSubstr("the robot's tag (id 3) does not move in the whole film"));
}

INSTANTIATE_TEST_SUITE_P(Each, WrongFilm, testing::ValuesIn(support::film::wrong_film_names()),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Refused before the film is looked at.
TEST(WrongOptions, OfAFilmSayWhichPartOfThemIsWrong) {
  const std::vector<WrongWords> all{
      {{"--tape", "1:4=3457"}, "'3457' is not a length from 0.1 to 100 m"},
      {{"--tape", "1:4=3,457"}, "'3,457' is not a length"},
      {{"--tape", "1-4=3.457"}, "'1-4=3.457' is not a distance between two floor tags"},
      {{"--tape", "1:1=3.457"}, "'1:1=3.457' is not a distance between two floor tags"},
      {{"--readout", "0.018"}, "no camera reads a picture in 0.018 ms"},
      {{"--csv", "a", "--tum", "./a"}, "'./a' would be written twice"}};
  for (const WrongWords& wrong : all) {
    std::vector<std::string> words{"truth", "film", "film.mp4"};
    words.insert(words.end(), wrong.words.begin(), wrong.words.end());
    const Outcome outcome = support::astrolabe(words);
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr(wrong.fact));
  }
}

TEST(NoFilm, WithoutItsReaderSaysWhatToInstall) {
  const test::TemporaryFolder folder;
  const fs::path film = folder.path() / "film.mp4";
  std::ofstream(film) << "not looked at";
  support::Program program(
      {"/usr/bin/env", "PATH=/nowhere", ASTROLABE_PROGRAM, "truth", "film", film.string()});
  EXPECT_EQ(program.wait(), 1);
  EXPECT_THAT(program.err(), HasSubstr("apt install ffmpeg"));
}

TEST(NoFilm, IsATextFile) {
  const test::TemporaryFolder folder;
  const fs::path film = folder.path() / "film.mp4";
  std::ofstream(film) << "time_s,x_m,y_m\n0,0,0\n";
  const Outcome outcome = support::astrolabe({"truth", "film", film.string()});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("film.mp4"), HasSubstr("MP4 or MOV")));
}

}  // namespace
}  // namespace astro
