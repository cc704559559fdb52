#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "host/base/pose2.hpp"
#include "host/truth/live/socket_source.hpp"
#include "tests/support/base/json.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/film/film_stage.hpp"
#include "tests/support/programs/program.hpp"
#include "tests/support/programs/tmux_program.hpp"

// A phone on a tripod films what the simulated robot drives: films are made here of where its cameras saw it.
namespace astro {
namespace {

using support::Outcome;
using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;
namespace stage = support::film;

constexpr double kTrueEd = 1.00416, kScale = 1.003, kTrueBase_m = 0.28861;

stage::PoseTrack track_of(const std::vector<recording::TruthSample>& samples) {
  constexpr double kInterval_s = 0.01;
  const Pose2 home = pose_of(samples.front());
  std::vector<stage::FloorPose> poses;
  double before_rad = 0;
  const auto at = [&](const recording::TruthSample& sample) {
    const Pose2 pose = home.between(pose_of(sample));
    before_rad += std::remainder(pose.theta_rad - before_rad, 2 * std::numbers::pi);
    return stage::compose({0, 0, 94 * stage::kDegree}, {pose.x_m, pose.y_m, before_rad});
  };
  const double begin_s = 1e-6 * static_cast<double>(samples.front().time_us);
  for (const recording::TruthSample& sample : samples) {
    const double time_s = 1e-6 * static_cast<double>(sample.time_us) - begin_s;
    const stage::FloorPose pose = at(sample);
    while (kInterval_s * static_cast<double>(poses.size()) <= time_s) poses.push_back(pose);
  }
  return {begin_s, kInterval_s, poses};
}

/// What a phone on a shelf films meanwhile: few pictures, so that they are quickly made.
void film(const std::vector<recording::TruthSample>& samples, const fs::path& mp4) {
  stage::FilmSetup setup;
  const stage::PoseTrack track = track_of(samples);
  setup.scene.floor = stage::tags_around(false);
  setup.scene.robots.push_back(stage::filmed(track));
  setup.lens = stage::at_720p(stage::main_lens());
  setup.camera = [](double) { return stage::on_shelf(); };
  setup.shutter = {0.02, 0.008};
  setup.clock.fps = 10;
  setup.codec.mbit_per_s = 4;
  setup.begin_s = track.begin_s() + 0.1;
  setup.end_s = track.end_s() - 0.1;
  make_film(setup, mp4);
}

class FilmedUmbmark : public testing::Test {
 protected:
  FilmedUmbmark() : cameras_(truth::mocap_socket_of(simulator_.port())) {}

  fs::path out() const { return simulator_.folder() / "x"; }

  /// Drives on, while what the cameras see is kept.
  Outcome umbmark(const std::string& source) {
    seen_.clear();
    support::Program program(
        {ASTROLABE_PROGRAM, "umbmark",      "--truth",          source,   "--port",     simulator_.port(),
         "--out",           out().string(), "--runs",           "1",      "--side",     "1",
         "--speed",         "0.4",          "--no-extras",      "--yes",  "--tag-side", "120.1mm",
         "--tag-height",    "121mm",        "--floor-tag-side", "159.9mm"});
    while (program.running()) drain();
    drain();
    return {program.wait(), program.out(), program.err()};
  }
  void drain() {
    const auto samples = cameras_.poll();
    seen_.insert(seen_.end(), samples.begin(), samples.end());
  }
  double parameter(const std::string& name) const {
    return support::parse_json(
               support::astrolabe({"params", "get", name, "--json", "--port", simulator_.port()}).out)
        .at("value")
        .get<double>();
  }

  support::Simulator simulator_{{"--fast", "--true-ed", fmt::format("{}", kTrueEd), "--true-wheelbase",
                                 fmt::format("{}", kTrueBase_m), "--scale", fmt::format("{}", kScale),
                                 "--seed", "4"}};
  truth::SocketSource cameras_;
  std::vector<recording::TruthSample> seen_;
};

TEST_F(FilmedUmbmark, WaitsAtATerminalUntilSomebodyFilms) {
  support::TmuxProgram umbmark(
      fmt::format("{} umbmark --truth film --port {} --out {} --runs 1 --side 1 --no-extras --yes",
                  ASTROLABE_PROGRAM, simulator_.port(), out().string()));
  ASSERT_TRUE(umbmark.shows("Begin to film phase 'before'")) << umbmark.seen();
  EXPECT_THAT(umbmark.seen(), HasSubstr("4 of 4 runs are to be driven"));
  EXPECT_THAT(umbmark.seen(), Not(HasSubstr("recorded")));
  umbmark.type("wait");
  ASSERT_TRUE(umbmark.shows("'wait' is no answer")) << umbmark.seen();
  umbmark.type("");
  ASSERT_TRUE(umbmark.shows("recorded before: square ccw 1", [this] { drain(); })) << umbmark.seen();
  EXPECT_THAT(umbmark.seen(), HasSubstr("recorded before: square cw 1")) << "and does not ask again";
}

TEST_F(FilmedUmbmark, TakesAFilmOfEachPhaseAndLoadsTheFactorsThatItShows) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  const Outcome driven = umbmark("film");
  ASSERT_EQ(driven.code, 1);
  ASSERT_THAT(driven.err, HasSubstr("all runs of phase 'before' are driven, but their film is missing"));
  ASSERT_GT(seen_.size(), 1000U);
  const fs::path before = simulator_.folder() / "before.mp4", after = simulator_.folder() / "after.mp4";
  film(seen_, before);

  const Outcome loaded = umbmark("film:" + before.string());
  ASSERT_EQ(loaded.code, 1) << loaded.out << loaded.err;
  // That film would fit the runs after as well.
  EXPECT_THAT(loaded.err, HasSubstr("'before.mp4' shows the runs of an earlier phase"));
  ASSERT_THAT(loaded.err, HasSubstr("all runs of phase 'after' are driven, but their film is missing"));
  // Four standard errors of two squares with the simulator's slip.
  EXPECT_NEAR(parameter("c_R") / parameter("c_L"), kTrueEd, 0.004);
  EXPECT_NEAR(parameter("b") / kTrueBase_m, 1, 0.008);
  film(seen_, after);

  const Outcome done = umbmark("film:" + after.string());
  EXPECT_EQ(done.code, 0) << done.err;
  EXPECT_THAT(done.err, Not(HasSubstr("left out")));
  EXPECT_TRUE(fs::exists(out() / "report.html"));
}

}  // namespace
}  // namespace astro
