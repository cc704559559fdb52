#include "host/truth/source/manual_source.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "host/base/pose2.hpp"
#include "host/base/text/trimmed.hpp"
#include "host/recording/run_metadata.hpp"
#include "host/truth/source/plausibility.hpp"

namespace astro::truth {
namespace {

Pose2 odometry_end(const recording::Run& run) {
  if (run.odometry.empty()) return {};
  return wrapped(pose_of(run.odometry.front()).between(pose_of(run.odometry.back())));
}

enum class Outcome { entered, back, redo };

/// The questions about one run.
class Form {
 public:
  Form(const Ask& ask, const Units& units, const recording::Run& run)
      : ask_(ask), units_(units), run_(run), odometry_(odometry_end(run)) {}

  Outcome fill(recording::TruthSample& end) {
    const std::string heading =
        fmt::format("  heading, counter-clockwise, {} (odometry {}; empty: none): ", name_of(units_.angle),
                    shown(odometry_.theta_rad, units_.angle));
    const auto length = [&](const std::string& text) { return length_m_in(text, units_.length); };
    const auto angle = [&](const std::string& text) -> std::optional<double> {
      return text.empty() ? std::numeric_limits<double>::quiet_NaN() : angle_rad_in(text, units_.angle);
    };
    const std::string about =
        recording::run_name(run_.info) +
        ": where does the robot stand?\n  ('back' begins again, 'redo' has it driven again)\n";
    Outcome outcome = number(position("x, forward of the start mark", odometry_.x_m), length, end.x_m, about);
    if (outcome == Outcome::entered)
      outcome = number(position("y, left of it", odometry_.y_m), length, end.y_m);
    if (outcome == Outcome::entered) outcome = number(heading, angle, end.theta_rad);
    return outcome;
  }

 private:
  std::string position(const char* what, double odometry_m) const {
    return fmt::format("  {}, {} (odometry {}): ", what, name_of(units_.length),
                       shown(odometry_m, units_.length));
  }

  /// Asks until the answer is a number, or a word that is none.
  template <class Read>
  Outcome number(const std::string& prompt, const Read& read, double& value, const std::string& about = "") {
    Question question{about + prompt};
    while (true) {
      const std::string answer(trimmed(ask_(question)));
      if (answer == "back") return Outcome::back;
      if (answer == "redo") return Outcome::redo;
      if (const auto number = read(answer)) {
        value = *number;
        return Outcome::entered;
      }
      question = {".\n" + prompt,
                  {"  '" + answer + "' is not a number in a known unit; write it with a decimal point"}};
    }
  }

  const Ask& ask_;
  const Units& units_;
  const recording::Run& run_;
  Pose2 odometry_;
};

}  // namespace

bool ManualSource::is_right(const recording::Run& run, const recording::TruthSample& end) {
  const std::string why = implausible_end(run, {}, end);
  if (why.empty()) return true;
  const Question question{
      "", {recording::run_name(run.info) + ": " + why}, AnswerKind::right_or_entered_again};
  const std::string answer(trimmed(ask_(question)));
  return answer == "y" || answer == "yes";
}

std::optional<std::vector<recording::TruthSample>> ManualSource::complete(const recording::Run& run) {
  while (true) {
    recording::TruthSample end;
    const Outcome outcome = Form(ask_, units_, run).fill(end);
    if (outcome == Outcome::redo) return std::nullopt;
    if (outcome == Outcome::entered && is_right(run, end)) return at_both_ends(run, {}, end);
  }
}

std::vector<recording::TruthSample> at_both_ends(const recording::Run& run,
                                                 const recording::TruthSample& start,
                                                 const recording::TruthSample& end, std::int64_t stretch_us) {
  std::vector<recording::TruthSample> samples;
  for (const recording::OdometrySample& odometry : run.odometry) {
    const bool early = odometry.time_us - run.odometry.front().time_us <= stretch_us;
    const bool late = run.odometry.back().time_us - odometry.time_us <= stretch_us;
    if (!early && !late) continue;
    recording::TruthSample sample = early ? start : end;
    sample.time_us = odometry.time_us;
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace astro::truth
