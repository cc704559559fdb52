#include "host/commands/experiment/wall_dialogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "host/base/text/columns.hpp"
#include "host/base/text/numbers.hpp"
#include "host/base/text/trimmed.hpp"
#include "host/commands/shared/gyro_view.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/wall/wall_programme.hpp"

namespace astro::commands {
namespace {

constexpr const char* kDrawing = R"(
     wall  =========================================
                  |         the ruler lies here: from the
                  | gap     wall to the front of the robot,
                  |         square to the wall
               +--+--+
               |  ^  |      the robot faces the wall, a hand's
             []|  :  |[]    breadth in front of it; by eye is
               +-----+      enough
)";

/// Includes how much further the robot may go if its wheels are larger than its parameters say.
double depth_m(const wall::WallPlan& plan) {
  const wall::BodySize& body = plan.body;
  const double turning_m = 2 * (body.turning_gap_m() + body.front_to_axle_m);
  return (1 + wall::kFurther) *
         std::max(plan.line_m + turning_m, plan.readings > 0 ? plan.gap_m + body.length_m : 0.0);
}

std::string scale_text(const std::optional<wall::WallScale>& scale) {
  if (!scale) return "S is as loaded: nobody read a ruler.";
  if (scale->readings == 1) return "S is from one reading of the ruler, which nothing else checks.";
  std::string text = fmt::format("S is from {} readings of the ruler.", scale->readings);
  if (scale->left_out > 0)
    text += fmt::format(" {} that these contradict {} left out.", scale->left_out,
                        scale->left_out == 1 ? "was" : "were");
  if (scale->contradictory())
    text += fmt::format(" They contradict each other: they scatter {:.0f} times as much as they should.",
                        scale->scatter);
  return text;
}

std::string percent(double ratio) { return fmt::format("{:.3f} %", 100 * ratio); }

std::string in_minutes(double minutes) {
  return minutes <= 1 ? "a minute" : fmt::format("{:.0f} minutes", std::ceil(minutes));
}

std::string ruler_text(const wall::WallPlan& plan, int readings) {
  if (plan.readings == 0) return "Without a ruler the scale of the wheels stays as it is. ";
  if (readings == 0) return "";
  const char* times = readings == 1 ? "once" : readings == 2 ? "twice" : nullptr;
  return fmt::format("It asks {} for the gap between the wall and its front, of about {:g} m. ",
                     times != nullptr ? times : fmt::format("{} times", readings), plan.gap_m);
}

}  // namespace

std::string wall_briefing(const wall::WallPlan& plan, const wall::WallCourse& course, int readings,
                          double driven_s) {
  const double minutes = std::min(plan.most_minutes, course.time_s / 60) - driven_s / 60;
  const std::string text = fmt::format(
      "The robot squares itself against a straight, firm wall, with a push of at most {:g} N; backs off, "
      "drives laps, and comes back, again "
      "and again. It needs {:.1f} m of free, clean floor in front of the wall and a metre to each side, and "
      "about {}. {}"
      "Nobody may touch it while it drives; Ctrl-C stops it, and the same command goes on.",
      plan.push.force_N, depth_m(plan), in_minutes(minutes), ruler_text(plan, readings));
  return wrapped(text) + kDrawing;
}

void ask_facing_wall(const AskLine& ask) {
  press_enter(ask, "Put the robot in front of the wall, facing it, step aside and press Enter ");
}

namespace {

constexpr const char* kNoLength = "'{}' is not a length in a known unit; write it with a decimal point.\n{}";
constexpr double kLongest_m =
    1e5;  // 100 m in millimetres, read as metres: the question about the doubtful gap names the unit

bool is_length(const std::optional<double>& gap_m) { return gap_m && *gap_m > 0 && *gap_m < kLongest_m; }

}  // namespace

std::optional<double> ask_gap(const AskLine& ask, double expected_m, truth::LengthUnit unit) {
  const std::string question = fmt::format(
      "Gap between the wall and the front of the robot, {} (by its wheels {};\n'none': not measured; the "
      "robot "
      "drives on after Enter): ",
      truth::name_of(unit), truth::shown(expected_m, unit));
  std::string prompt = question;
  while (true) {
    const std::string line = ask(prompt), answer(trimmed(line));
    if (answer == "none") return std::nullopt;
    if (const auto gap_m = truth::length_m_in(answer, unit); is_length(gap_m)) return gap_m;
    prompt = fmt::format(kNoLength, answer, question);
  }
}

std::optional<double> ask_gap_again(const AskLine& ask, const wall::GapDoubt& doubt, truth::LengthUnit unit) {
  const std::string why = doubt.why + (doubt.possible ? "." : ", which no calibration mends.");
  const std::string question =
      wrapped(why) +
      fmt::format("  Read it again, {}{}: ", truth::name_of(unit),
                  doubt.possible ? " ('yes': it is right; 'none': not measured)" : " ('none': not measured)");
  std::string prompt = question;
  while (true) {
    const std::string line = ask(prompt), answer(trimmed(line));
    if (answer == "none") return std::nullopt;
    if (doubt.possible && (answer == "y" || answer == "yes")) return doubt.read_m;
    if (const auto gap_m = truth::length_m_in(answer, unit); is_length(gap_m)) return gap_m;
    prompt = fmt::format(kNoLength, answer, question);
  }
}

std::string title_of(const wall::WallMove& move) {
  using Kind = wall::WallMove::Kind;
  const char* way = move.turns > 0 ? "counter-clockwise" : "clockwise";
  const int turns = std::abs(move.turns);
  switch (move.kind) {
    case Kind::repeat:
      return "squaring once more";
    case Kind::gap:
      return fmt::format("{:g} m off for the ruler", move.away_m);
    case Kind::laps:
      return fmt::format("{} lap{} {}", turns, turns == 1 ? "" : "s", way);
    default:
      return fmt::format("{} turn{} {}", turns, turns == 1 ? "" : "s", way);
  }
}

std::string wall_result_text(const wall::WallResult& result) {
  using experiment::with_error;
  const wall::WallEstimate& found = result.estimate;
  const calibration::WheelFactors& factors = found.factors;
  const auto deviation = [&](int index) { return std::sqrt(found.covariance(index, index)); };
  std::vector<std::vector<std::string>> rows{
      {"", "", "± of it"},
      {"c_R", with_error(factors.c_r, deviation(0), 8), percent(deviation(0) / factors.c_r)},
      {"c_L", with_error(factors.c_l, deviation(1), 8), percent(deviation(1) / factors.c_l)},
      {"b mm", with_error(1000 * factors.b_m, 1000 * deviation(2), 4), percent(deviation(2) / factors.b_m)},
      {"E_d", with_error(found.E_d, found.se.E_d, 7), percent(found.se.E_d)},
      {"b/S mm", with_error(1000 * found.b_per_scale_m, 1000 * found.b_per_scale_m * found.se.b, 4),
       percent(found.se.b)}};
  if (found.scale)
    rows.push_back({"S", with_error(found.scale->scale, found.scale->se, 8), percent(found.scale->se)});
  const std::string driven = fmt::format(
      "{} ways between {} squarings, {:.1f} minutes of driving. A squaring is off by {:.1f} mrad; the wheels "
      "slip by {:.1f} mm on a metre. {} e is as loaded: "
      "laps do not show it.",
      found.stretches.size(), found.stretches.size() + result.journal.drive.size(),
      result.journal.driven_s / 60, 1000 * found.noise.squaring_rad, 1000 * std::sqrt(found.noise.K_m),
      scale_text(found.scale));
  std::string text = console::table(rows) + '\n' + wrapped(driven);
  if (result.gyro) text += gyro_text(*result.gyro);
  if (!result.reached)
    text +=
        wrapped(fmt::format("The wanted precision (E_d {}, b {}) was not reached in {:g} minutes; more of "
                            "them, with --minutes and another --out, would help.",
                            percent(result.journal.plan.targets.E_d), percent(result.journal.plan.targets.b),
                            result.journal.plan.most_minutes));
  return text;
}

}  // namespace astro::commands
