#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "host/base/pose2.hpp"
#include "host/truth/live/socket_source.hpp"
#include "tests/support/base/columns.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/tmux_program.hpp"

// The whole dialogue with a wall and a ruler in a terminal of 80 columns.
namespace astro {
namespace {

using support::TmuxProgram;
using testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double kGap_m = 0.15;  // from the front to the wall when the simulator starts

class Wall : public testing::Test {
 protected:
  Wall() : cameras_(truth::mocap_socket_of(simulator_.port())) { start_ = where(); }

  fs::path out() const { return simulator_.folder() / "x"; }
  std::string command(const std::string& more = "") const {
    return std::string(ASTROLABE_PROGRAM) + " umbmark --truth wall --port " + simulator_.port() + " --out " +
           out().string() + " --line 2 --gap 1 --until 0.2% " + more;
  }

  bool drain() {
    bool any = false;
    for (auto samples = cameras_.poll(); !samples.empty(); samples = cameras_.poll()) {
      any = true;
      pose_ = {samples.back().x_m, samples.back().y_m, samples.back().theta_rad};
    }
    return any;
  }
  /// The time of a fast simulator stands still while nobody talks to it, so somebody talks until the cameras have sent a picture.
  Pose2 where() {
    for (drain(); !drain();) support::astrolabe({"info", "--port", simulator_.port()});
    return pose_;
  }
  /// What a ruler shows, in mm: the robot began at right angles to the wall.
  double ruler_mm() { return 1000 * (kGap_m - start_.between(where()).x_m); }

  bool asks_for_gap(TmuxProgram& program) {
    return program.shows("drives on after Enter):", [this] { drain(); });
  }
  double parameter(const std::string& name) const {
    return support::parse_json(
               support::astrolabe({"params", "get", name, "--json", "--port", simulator_.port()}).out)
        .at("value")
        .get<double>();
  }

  support::Simulator simulator_{{"--fast", "--true-ed", "1.00416", "--true-wheelbase", "0.28861", "--scale",
                                 "1.01", "--seed", "4", "--wall", fmt::format("{}", kGap_m)}};
  truth::SocketSource cameras_;
  Pose2 start_, pose_;
};

TEST_F(Wall, GuidesThroughACalibrationCatchesAMistypedGapAndLoadsTheFactors) {
  TmuxProgram umbmark(command("--yes"));
  ASSERT_TRUE(umbmark.shows("Unit of the lengths you type")) << umbmark.seen();
  EXPECT_THAT(umbmark.seen(), HasSubstr("squares itself against a straight, firm wall"));
  umbmark.type("mm");
  ASSERT_TRUE(umbmark.shows("step aside and press Enter")) << umbmark.seen();
  umbmark.type("");
  ASSERT_TRUE(asks_for_gap(umbmark)) << umbmark.seen();
  umbmark.type(fmt::format("{:.0f}", ruler_mm() / 10));
  ASSERT_TRUE(umbmark.shows("in another unit")) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("Read it again, mm")) << umbmark.seen();
  umbmark.type(fmt::format("{:.0f}", ruler_mm()));
  ASSERT_TRUE(asks_for_gap(umbmark)) << umbmark.seen();
  umbmark.type(fmt::format("{:.1f} cm", ruler_mm() / 10));
  ASSERT_TRUE(umbmark.shows("Calibration: ", [this] { drain(); })) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("the robot holds the new set")) << umbmark.seen();
  const std::string seen = umbmark.seen();
  EXPECT_THAT(seen, HasSubstr("S is from 2 readings of the ruler."));
  EXPECT_LE(support::widest_line(seen), 80U) << seen;
  // Wheels of 1.01 times the nominal diameter and a ratio of 1.00416; wanted to 0.2 %, and five of that.
  EXPECT_NEAR((parameter("c_R") + parameter("c_L")) / 2, 1.01, 0.01);
  EXPECT_NEAR(parameter("c_R") / parameter("c_L"), 1.00416, 0.01);
  EXPECT_NEAR(parameter("b"), 0.28861, 0.003);
  std::ostringstream file;
  file << std::ifstream(out() / "calib.toml").rdbuf();
  EXPECT_THAT(file.str(), HasSubstr("method = \"wall\""));
  EXPECT_THAT(file.str(), HasSubstr("absolute = true"));
}

TEST_F(Wall, GoesOnAfterCtrlC) {
  TmuxProgram first(command("--yes --unit mm"));
  ASSERT_TRUE(first.shows("step aside and press Enter")) << first.seen();
  first.type("");
  ASSERT_TRUE(asks_for_gap(first)) << first.seen();
  first.key("C-c");
  ASSERT_TRUE(first.shows("interrupted; the same command goes on")) << first.seen();
  // The person puts it in front of the wall again: drives it there.
  const auto back = support::astrolabe({"drive", "line", "0.9", "--port", simulator_.port()});
  ASSERT_EQ(back.code, 0) << back.err;
  TmuxProgram second(command("--yes --unit mm"));
  ASSERT_TRUE(second.shows("step aside and press Enter")) << second.seen();
  second.type("");
  for (int reading = 0; reading < 2; ++reading) {
    ASSERT_TRUE(asks_for_gap(second)) << second.seen();
    second.type("none");
  }
  ASSERT_TRUE(second.shows("Calibration: ", [this] { drain(); })) << second.seen();
  EXPECT_THAT(second.seen(), HasSubstr("nobody read a ruler"));
  ASSERT_TRUE(second.shows("the robot holds the new set")) << second.seen();
}

TEST_F(Wall, FinishedAsksForNothingMoreAndSaysHowToLoadWhatAPersonDeclined) {
  TmuxProgram first(command("--readings 0"));
  ASSERT_TRUE(first.shows("step aside and press Enter")) << first.seen();
  first.type("");
  ASSERT_TRUE(first.shows("Load these into the robot?", [this] { drain(); })) << first.seen();
  first.type("n");
  ASSERT_TRUE(first.shows("loads it later")) << first.seen();
  TmuxProgram again(command("--readings 0 --yes"));
  ASSERT_TRUE(again.shows("the robot holds the new set")) << again.seen();
  EXPECT_THAT(again.seen(), testing::Not(HasSubstr("in front of")));
  const auto report = support::astrolabe({"report", out().string()});
  EXPECT_EQ(report.code, 1);
  EXPECT_THAT(report.err, HasSubstr("calib.toml"));
}

TEST_F(Wall, RefusesOptionsThatChangeNothing) {
  const auto refused = [&](std::vector<std::string> more) {
    std::vector<std::string> words{"umbmark", "--port", simulator_.port(), "--out", out().string()};
    words.insert(words.end(), more.begin(), more.end());
    const auto result = support::astrolabe(words);
    EXPECT_EQ(result.code, 2) << result.err;
    return result.err;
  };
  EXPECT_THAT(refused({"--truth", "wall", "--side", "3"}), HasSubstr("--side is of squares"));
  EXPECT_THAT(refused({"--truth", "wall", "--method", "ml"}), HasSubstr("--method is of squares"));
  EXPECT_THAT(refused({"--truth", "manual", "--push", "9"}), HasSubstr("--push is of --truth wall"));
  const auto too_weak = support::astrolabe({"umbmark", "--port", simulator_.port(), "--out", out().string(),
                                            "--truth", "wall", "--push", "2", "--unit", "mm"});
  EXPECT_EQ(too_weak.code, 1);
  EXPECT_THAT(too_weak.err, HasSubstr("the wheels would not start turning"));
}

}  // namespace
}  // namespace astro
