#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <map>

#include "host/base/pose2.hpp"
#include "host/base/text/degrees.hpp"
#include "host/truth/live/socket_source.hpp"
#include "tests/support/base/columns.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/tmux_program.hpp"

// The whole dialogue with a tape measure in a terminal of 80 columns.
namespace astro {
namespace {

using support::TmuxProgram;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

/// A simulated robot of the thesis with all its slip, and its true pose.
class Robot {
 public:
  Robot() : cameras_(truth::mocap_socket_of(simulator_.port())) {}

  /// Takes what the cameras sent; a fast simulator waits for those who read slowly. False if nothing has come.
  bool drain() {
    bool any = false;
    while (true) {
      const std::vector<recording::TruthSample> samples = cameras_.poll();
      if (samples.empty()) return any;
      any = true;
      pose_ = {samples.back().x_m, samples.back().y_m, samples.back().theta_rad};
    }
  }

  /// Where it stands. The time of a fast simulator stands still while nobody talks to it, so somebody talks until the
  /// cameras have sent a picture of the robot at rest.
  Pose2 where() {
    for (drain(); !drain();) support::astrolabe({"info", "--port", port()});
    return pose_;
  }
  std::string port() const { return simulator_.port(); }
  fs::path out() const { return simulator_.folder() / "x"; }

 private:
  support::Simulator simulator_{
      {"--fast", "--true-ed", "1.00416", "--true-wheelbase", "0.28861", "--seed", "3"}};
  truth::SocketSource cameras_;
  Pose2 pose_;
};

struct Answers {
  std::string x, y, heading;
};

class Tape : public testing::Test {
 protected:
  std::string command(const std::string& more) const {
    return std::string(ASTROLABE_PROGRAM) + " umbmark --truth manual --port " + robot_.port() + " --out " +
           robot_.out().string() + ' ' + more;
  }

  /// Puts the robot on its mark and lets it drive.
  void drive(TmuxProgram& umbmark, const std::string& run) {
    ASSERT_TRUE(umbmark.shows("next is " + run + ": put the robot on its start mark and press Enter"))
        << umbmark.seen();
    start_ = robot_.where();
    umbmark.type("");
    ASSERT_TRUE(umbmark.shows("x, forward of the start mark", [this] { robot_.drain(); })) << umbmark.seen();
  }

  /// What the tape says, in millimetres and degrees.
  Answers measured() {
    const Pose2 end = start_.between(robot_.where());
    return {fmt::format("{:.0f}", 1000 * end.x_m), fmt::format("{:.0f}", 1000 * end.y_m),
            fmt::format("{:.1f}", degrees(wrapped_rad(end.theta_rad)))};
  }

  static void answer(TmuxProgram& umbmark, const Answers& answers) {
    umbmark.type(answers.x);
    ASSERT_TRUE(umbmark.shows("y, left of it")) << umbmark.seen();
    umbmark.type(answers.y);
    ASSERT_TRUE(umbmark.shows("heading, counter-clockwise")) << umbmark.seen();
    umbmark.type(answers.heading);
  }

  static void expect_80_columns(const std::string& text) {
    EXPECT_LE(support::widest_line(text), 80U) << text;
  }

  Robot robot_;
  Pose2 start_;
};

TEST_F(Tape, SaysBeforeItStartsWhatThereIsToDoHowLongItTakesAndWhereToPutTheTape) {
  TmuxProgram umbmark(command("--runs 5"));
  ASSERT_TRUE(umbmark.shows("Unit of the lengths you type: mm, cm or m? [mm]")) << umbmark.seen();
  const std::string seen = umbmark.seen();
  EXPECT_THAT(seen, HasSubstr("26 of 26 runs are to be driven"));
  EXPECT_THAT(seen, HasSubstr("5 + 5 squares and 3 lines"));
  EXPECT_THAT(seen, HasSubstr("78"));
  EXPECT_THAT(seen, testing::ContainsRegex("It takes about [0-9]+"));
  EXPECT_THAT(seen, HasSubstr("x, ahead"));
  EXPECT_THAT(seen, HasSubstr("y, left <-+"));
  EXPECT_THAT(seen, HasSubstr("18/300"));
  umbmark.type("inch");
  ASSERT_TRUE(umbmark.shows("mm, cm or m? [mm]")) << umbmark.seen();
  umbmark.type("cm");
  ASSERT_TRUE(umbmark.shows("next is before: square cw 1")) << umbmark.seen();
}

TEST_F(Tape, AsksInTheChosenUnitWithOdometryBesideAndLetsOneCorrectAndRedo) {
  TmuxProgram umbmark(command("--runs 1 --side 1 --no-extras --unit cm --angle-unit rad"));
  drive(umbmark, "before: square cw 1");
  ASSERT_TRUE(umbmark.shows("cm (odometry ")) << umbmark.seen();
  umbmark.type("ten");
  ASSERT_TRUE(umbmark.shows("'ten' is not a number in a known unit")) << umbmark.seen();
  umbmark.type("12 mm");
  ASSERT_TRUE(umbmark.shows("y, left of it, cm (odometry ")) << umbmark.seen();
  umbmark.type("back");
  ASSERT_TRUE(umbmark.shows("x, forward of the start mark")) << umbmark.seen();
  umbmark.type("redo");
  drive(umbmark, "before: square cw 1");
  const Answers honest = measured();
  answer(umbmark, {honest.x + " mm", honest.y + "mm", honest.heading + " deg"});
  ASSERT_TRUE(umbmark.shows("recorded before: square cw 1")) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("'back' corrects before: square cw 1, 'redo' drives it again")) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("next is before: square ccw 1")) << umbmark.seen();
  umbmark.type("back");
  ASSERT_TRUE(umbmark.shows("x, forward of the start mark")) << umbmark.seen();
  answer(umbmark, {honest.x + " mm", honest.y + "mm", ""});
  ASSERT_TRUE(umbmark.shows("next is before: square ccw 1")) << umbmark.seen();
  umbmark.type("redo");
  ASSERT_TRUE(umbmark.shows("next is before: square cw 1")) << umbmark.seen();
}

/// Ten squares and three lines with a tenfold x, 1200 for 1.2, a changed sign, a missing heading and a dropped digit in different
/// runs. Whatever is asked about is answered with the honest numbers.
TEST_F(Tape, CatchesOrBearsEveryMistakeAndLoadsTheRobotsFactorsWithItsScale) {
  TmuxProgram umbmark(command("--runs 5 --unit m --yes"));
  std::map<std::string, Answers> notes;
  std::vector<std::string> runs;
  for (int i = 1; i <= 5; ++i)
    for (const char* way : {"cw", "ccw"}) runs.push_back(fmt::format("before: square {} {}", way, i));
  for (int i = 1; i <= 3; ++i) runs.push_back(fmt::format("before: line {}", i));

  int asked = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string& run = runs[i];
    drive(umbmark, run);
    Answers honest = measured();
    for (std::string* length : {&honest.x, &honest.y}) *length += " mm";
    notes[run] = honest;
    Answers typed = honest;
    const double x_mm = std::stod(honest.x);
    if (run == "before: square cw 1") typed.x = fmt::format("{:.0f} mm", 10 * x_mm);
    if (run == "before: square ccw 2")
      typed.x = fmt::format("{:.0f}", x_mm);  // millimetres, and metres are meant
    if (run == "before: square cw 4") typed.y = honest.y[0] == '-' ? honest.y.substr(1) : '-' + honest.y;
    if (run == "before: square ccw 5") typed.heading = "";
    if (run == "before: line 2") typed.x = fmt::format("{:.0f} mm", x_mm / 10);
    answer(umbmark, typed);
    // The next thing that is shown is a question about an end, or the next run.
    const std::string next = i + 1 < runs.size() ? "next is " + runs[i + 1] : "calibrated by robust";
    while (true) {
      std::string seen;
      ASSERT_TRUE(support::eventually([&] {
        seen = umbmark.seen();
        const std::string tail = seen.substr(std::min(seen.size(), seen.rfind("heading, counter-clockwise")));
        return tail.find(next) != std::string::npos || tail.find("enter it again") != std::string::npos;
      })) << umbmark.seen();
      const std::string tail = seen.substr(seen.rfind("heading, counter-clockwise"));
      if (tail.find(next) != std::string::npos) break;
      ++asked;
      if (tail.find("Enter: enter it again") != std::string::npos) {  // it can hardly be the end of the run
        umbmark.type("");
        ASSERT_TRUE(umbmark.shows("Enter: enter it again"));
        answer(umbmark, honest);
        continue;
      }
      const std::size_t at = tail.rfind("\nbefore: ") + 1;
      const std::string doubted = tail.substr(at, tail.find(':', at + 8) - at);
      ASSERT_TRUE(notes.contains(doubted)) << tail;
      ASSERT_TRUE(umbmark.shows("redo: drive it again:"));
      umbmark.type("back");
      ASSERT_TRUE(umbmark.shows("x, forward of the start mark")) << umbmark.seen();
      answer(umbmark, notes[doubted]);
    }
  }
  EXPECT_GE(asked, 4) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("S is from 3 measured lines")) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("next is after: square cw 1")) << umbmark.seen();
  expect_80_columns(umbmark.seen());

  std::ifstream file(robot_.out() / "calib-before.toml");
  std::stringstream calibration;
  calibration << file.rdbuf();
  EXPECT_THAT(calibration.str(), HasSubstr("method = \"robust\""));
  EXPECT_THAT(calibration.str(), HasSubstr("lines = 3"));
  const auto parameters = support::parse_json(
      support::astrolabe({"calibrate", "runs", (robot_.out() / "before").string(), "--json"}).out);
  const auto se = parameters["standard_errors"];
  const auto off = [&](const char* key, double truth) {
    return std::abs(parameters[key].get<double>() - truth) / se[key].get<double>();
  };
  // The largest of three normal numbers is below 3.5 in 998 of 1000 cases.
  EXPECT_LT(off("E_d", 1.00416), 3.5);
  EXPECT_LT(off("b_m", 0.28861), 3.5);
  EXPECT_LT(off("scale", 1), 3.5);
  EXPECT_FALSE(parameters.contains("left_out")) << "all mistakes were corrected";
}

TEST_F(Tape, AnEnterThatWasHitTwiceDoesNotLetTheRobotDriveAndNeitherDoesAWord) {
  TmuxProgram umbmark(command("--runs 1 --side 1 --unit mm --no-extras"));
  drive(umbmark, "before: square cw 1");
  Answers honest = measured();
  honest.heading += "\nno wait, not yet";  // typed ahead of the question whether it may drive
  answer(umbmark, honest);
  ASSERT_TRUE(umbmark.shows("next is before: square ccw 1")) << umbmark.seen();
  umbmark.type("no wait");
  ASSERT_TRUE(umbmark.shows("'no wait' is no answer to this")) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("next is before: square ccw 1")) << umbmark.seen();
  EXPECT_THAT(umbmark.seen(), Not(HasSubstr("run square ccw 1 (before)")));
}

TEST_F(Tape, ABadEndIsNamedWithWhatWouldFitBeforeAnythingIsKept) {
  TmuxProgram umbmark(command("--runs 1 --unit m --no-extras"));
  drive(umbmark, "before: square cw 1");
  Answers honest = measured();
  answer(umbmark, {"1200", honest.y + " mm", ""});
  ASSERT_TRUE(umbmark.shows("as if it were")) << umbmark.seen();
  ASSERT_TRUE(umbmark.shows("x = 1.2 m")) << umbmark.seen();
  EXPECT_FALSE(fs::exists(robot_.out() / "before" / "square-cw-1.mcap"));
  EXPECT_TRUE(fs::exists(robot_.out() / "before" / "square-cw-1.mcap.no-truth"));
}

}  // namespace
}  // namespace astro
