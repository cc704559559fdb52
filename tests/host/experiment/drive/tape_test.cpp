#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "host/base/pose2.hpp"
#include "host/base/text/degrees.hpp"
#include "host/experiment/drive/open_journal.hpp"
#include "host/truth/source/manual_source.hpp"
#include "tests/support/base/remarks.hpp"
#include "tests/support/base/thorough.hpp"
#include "tests/support/robots/desk.hpp"

// A person with a tape measure beside the robot of the thesis, with all its slip, who makes mistakes.
namespace astro::experiment {
namespace {

using support::Desk;
using support::kThesisSlip_m;
using support::TemporaryFolder;
using support::thesis_robot;

/// What is typed for a run; an empty heading was not measured.
struct Typed {
  double x_mm = 0, y_mm = 0, heading_deg = 0;
  std::string unit_of_x = "";
  bool heading = true;
};
using Mistakes = std::map<std::string, std::function<void(Typed&)>>;  // by the title of the run

/// Reads the tape to a millimetre and two marks to a tenth of a degree.
class PersonWithTape {
 public:
  PersonWithTape(Desk& desk, Mistakes mistakes) : desk_(desk), mistakes_(std::move(mistakes)) {}

  void put_on_mark(const RunSpec& next) {
    start_ = where();
    run_ = next.title();
  }

  std::string answer(const truth::Question& question) {
    if (question.answer == truth::AnswerKind::right_or_entered_again) {
      ++asked;
      return attentive ? "" : "y";
    }
    if (question.text.find("x, forward") != std::string::npos) measure();
    if (question.text.find("y, left") != std::string::npos) return fmt::format("{:.0f}", typed_.y_mm);
    if (question.text.find("heading") != std::string::npos)
      return typed_.heading ? fmt::format("{:.1f}", typed_.heading_deg) : "";
    return fmt::format("{:.0f}{}", typed_.x_mm, typed_.unit_of_x);
  }

  /// Corrects what was mistyped, if the question is about such a run.
  Redo doubt(const DoubtfulRun& run) {
    ++asked;
    const auto notes = notes_.find(run.spec.title());
    if (!attentive || notes == notes_.end() || !spoilt_.contains(notes->first)) return Redo::no;
    ++caught;
    from_notes_ = notes->first;
    return Redo::enter_again;
  }

  bool attentive = false;
  int asked = 0, caught = 0;

 private:
  Pose2 where() {
    for (const recording::TruthSample& sample : desk_.robot->take_truth()) last_ = sample;
    return {last_.x_m, last_.y_m, last_.theta_rad};
  }

  void measure() {
    if (!from_notes_.empty()) {
      typed_ = notes_[std::exchange(from_notes_, "")];
      return;
    }
    const Pose2 end = start_.between(where());
    typed_ = {1000 * end.x_m, 1000 * end.y_m, degrees(wrapped_rad(end.theta_rad))};
    notes_[run_] = typed_;
    const auto mistake = mistakes_.find(run_);
    if (mistake == mistakes_.end() || (attentive && spoilt_.contains(run_))) return;
    spoilt_.insert({run_, true});
    mistake->second(typed_);
  }

  Desk& desk_;
  Mistakes mistakes_;
  recording::TruthSample last_;
  Pose2 start_;
  Typed typed_;
  std::string run_, from_notes_;
  std::map<std::string, Typed> notes_;  // of the first reading of each run
  std::map<std::string, bool> spoilt_;
};

struct Outcome {
  Calibration found;
  int asked = 0, caught = 0;
};

/// The calibration after the runs before: five squares each way and three lines.
Outcome calibrate(std::uint64_t seed, const Mistakes& mistakes, bool attentive = false) {
  Desk desk(thesis_robot(kThesisSlip_m, seed));
  const TemporaryFolder folder;
  PersonWithTape person(desk, mistakes);
  person.attentive = attentive;
  Plan plan;
  plan.truth = "manual";
  Outcome outcome;
  ExperimentHooks hooks;
  hooks.ready = [&](const RunSpec& next, const auto&) { return person.put_on_mark(next), Redo::no; };
  hooks.doubt = [&](const DoubtfulRun& run) { return person.doubt(run); };
  hooks.decide = [&](const Calibration& found, const auto&) {
    return outcome.found = found, Decision::later;
  };
  hooks.force = true;
  truth::ManualSource tape([&](const truth::Question& question) { return person.answer(question); });
  EXPECT_THAT([&] { run_experiment(desk.client, tape, plan, folder.path(), hooks); },
              support::ThrowsTelling(ExperimentProblem::not_uploaded, folder.path().string()));
  outcome.asked = person.asked;
  outcome.caught = person.caught;
  return outcome;
}

/// The largest change of E_d, b and S, in standard errors of the experiment without mistakes.
double moved(const Calibration& without, const Calibration& with) {
  return std::max({std::abs(with.E_d() - without.E_d()) / without.se.E_d,
                   std::abs(with.factors.b_m - without.factors.b_m) / without.se.b_m,
                   std::abs(with.scale() - without.scale()) / without.se.scale});
}

constexpr std::uint64_t kSeeds = 6;

/// The same experiment without mistakes; driven once for each seed.
const Calibration& honest(std::uint64_t seed) {
  static std::map<std::uint64_t, Calibration> known;
  const auto found = known.find(seed);
  return found != known.end() ? found->second : known[seed] = calibrate(seed, {}).found;
}

const Mistakes kMistakes{
    {"before: square cw 1", [](Typed& typed) { typed.x_mm *= 10; }},
    {"before: square ccw 2", [](Typed& typed) { typed.unit_of_x = " m"; }},  // 1200 m for 1.2 m
    {"before: square cw 4", [](Typed& typed) { typed.y_mm = -typed.y_mm; }},
    {"before: square ccw 5", [](Typed& typed) { typed.heading = false; }},
    {"before: line 2", [](Typed& typed) { typed.x_mm /= 10; }}};

TEST(Tape, FindsTheRobotOfTheThesisWithItsScaleAndKnowsHowWell) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Calibration& found = honest(seed);
    const sim::Config robot = thesis_robot(kThesisSlip_m, seed);
    ASSERT_EQ(found.method(), "robust");
    ASSERT_TRUE(found.line_scale);
    const double of_E_d = (found.E_d() - robot.true_ed) / found.se.E_d,
                 of_b = (found.factors.b_m - robot.true_wheelbase_m) / found.se.b_m;
    fmt::print("seed {}: E_d {:.5f} ± {:.5f}, b {:.2f} ± {:.2f} mm, S {:.5f} ± {:.5f}\n", seed, found.E_d(),
               found.se.E_d, 1000 * found.factors.b_m, 1000 * found.se.b_m, found.scale(), found.se.scale);
    squares += of_E_d * of_E_d + of_b * of_b;
  }
  // Chi-square of 12 numbers is below 30 in 997 of 1000 cases.
  EXPECT_LT(squares, 30);
}

TEST(Tape, SaysWhatTheLinesOfAfterwardsShowOfTheScale) {
  sim::Config robot = thesis_robot(kThesisSlip_m, 1);
  robot.scale = 1.01;
  Desk desk(robot);
  const TemporaryFolder folder;
  PersonWithTape person(desk, {});
  Plan plan;
  plan.truth = "manual";
  plan.runs = 3;
  ExperimentHooks hooks;
  hooks.ready = [&](const RunSpec& next, const auto&) { return person.put_on_mark(next), Redo::no; };
  hooks.doubt = [&](const DoubtfulRun& run) { return person.doubt(run); };
  hooks.decide = [](const Calibration&, const auto&) { return Decision::load; };
  truth::ManualSource tape([&](const truth::Question& question) { return person.answer(question); });
  const Results results = run_experiment(desk.client, tape, plan, folder.path(), hooks);
  ASSERT_EQ(results.phases.size(), 2U);
  // Three lines of 3 m, each read to 2 mm, show the scale to some 0.05 %.
  EXPECT_NEAR(calibration::scale_of_lines(results.after().squares().lines)->scale, robot.scale, 4 * 5e-4);
  EXPECT_THAT(results.verdict(),
              testing::ContainsRegex("odometry said by [+](1|0[.]9).* before and [+-]0[.][01].* after"));
}

TEST(Tape, BearsFourMistakesInDifferentRunsAndALineThatNobodyCorrects) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Calibration& without = honest(seed);
    const Outcome with = calibrate(seed, kMistakes);
    const double by = moved(without, with.found);
    fmt::print("seed {}: asked {} times, {} squares left out, moved by {:.2f} standard errors\n", seed,
               with.asked, with.found.left_out.size(), by);
    EXPECT_LT(by, 3) << "seed " << seed;
    EXPECT_EQ(with.found.left_out.size(), 3U) << "all but the missing heading";
    squares += by * by / kSeeds;
  }
  // Without three squares of ten and a line of three, each of the three numbers moves by 0.65 or 0.7 standard errors (rms), and
  // the largest of them by about one.
  EXPECT_LT(std::sqrt(squares), 1.5);
}

TEST(Tape, IsAsGoodAsWithoutMistakesIfThePersonCorrectsWhatIsAskedAbout) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Calibration& without = honest(seed);
    const Outcome with = calibrate(seed, kMistakes, true);
    const double by = moved(without, with.found);
    fmt::print("seed {}: {} of {} questions led to a correction, moved by {:.2f} standard errors\n", seed,
               with.caught, with.asked, by);
    EXPECT_LT(by, 0.5) << "only the missing heading is left";
  }
}

TEST(Tape, BearsADroppedDigitInTheVeryFirstRun) {
  if (!support::thorough()) GTEST_SKIP() << support::kLeftToThorough;
  for (const char* first : {"before: square cw 1", "before: square ccw 1"})
    for (std::uint64_t seed = 1; seed <= kSeeds / 2; ++seed) {
      const Calibration& without = honest(seed);
      const Mistakes dropped{{first, [](Typed& typed) { typed.x_mm = std::trunc(typed.x_mm / 10); }}};
      const Outcome careless = calibrate(seed, dropped), attentive = calibrate(seed, dropped, true);
      fmt::print("{}, seed {}: moved by {:.2f} standard errors, {:.2f} after {} corrections\n", first, seed,
                 moved(without, careless.found), moved(without, attentive.found), attentive.caught);
      EXPECT_LT(moved(without, careless.found), 2);
      EXPECT_LT(moved(without, attentive.found), 2);
    }
}

}  // namespace
}  // namespace astro::experiment
