#include "host/experiment/analysis/judgement_sentences.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "host/experiment/analysis/scan_sentences.hpp"

namespace astro::experiment {
namespace {

using calibration::CrossValidation;
using calibration::HeldOutErrors;
using calibration::Verdict;

constexpr std::array<std::pair<Verdict, std::string_view>, 4> kNames{{{Verdict::better, "better"},
                                                                      {Verdict::worse, "worse"},
                                                                      {Verdict::undecided, "undecided"},
                                                                      {Verdict::unknown, "unknown"}}};

/// "the end error is 21.3 mm instead of 83.1 mm, the heading error 12 mrad instead of 76 mrad"
std::string comparison(const CrossValidation& judgement) {
  const HeldOutErrors before = judgement.in_use(), after = judgement.found();
  std::vector<std::string> parts;
  const auto add = [&](const char* what, double was, double is, const char* unit) {
    if (std::isfinite(was) && std::isfinite(is))
      parts.push_back(fmt::format("the {} {}{:.1f} {} instead of {:.1f} {}", what, parts.empty() ? "is " : "",
                                  1000 * is, unit, 1000 * was, unit));
  };
  add("end error", before.final_m, after.final_m, "mm");
  add("heading error", before.final_heading_rad, after.final_heading_rad, "mrad");
  add("path error", before.path_m, after.path_m, "mm");
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// The verdict weighs each moment of the drives, but end errors add up from the start of a drive. The two may contradict
/// each other if slip is larger than the effect of the factors, or if something is wrong with a drive.
std::string doubt_about(const CrossValidation& judgement) {
  const HeldOutErrors before = judgement.in_use(), after = judgement.found();
  if (!(after.final_m > before.final_m)) return "";
  return " The ends of the drives do not show it: they slipped by more than the factors change, or something "
         "is wrong with one "
         "of them.";
}

}  // namespace

std::string judgement_sentence(const CrossValidation& judgement) {
  const std::size_t drives = judgement.runs.size();
  if (judgement.verdict == Verdict::unknown)
    return judgement.not_judged.empty()
               ? "Whether it is better than what the robot carries cannot be judged from a single drive."
               : fmt::format("Whether it is better than what the robot carries cannot be judged: {}.",
                             judgement.not_judged.front().sentence);
  const std::string seen =
      fmt::format("on drives that it had not seen {} (root mean squares), and {} of {} drives fit better",
                  comparison(judgement), judgement.better_on(), drives);
  const std::string rest = judgement.not_judged.empty() ? ""
                                                        : fmt::format(" Not all is judged: {}.",
                                                                      judgement.not_judged.front().sentence);
  if (judgement.verdict == Verdict::better)
    return fmt::format("Better than what the robot carries: {}.{}{}", seen, doubt_about(judgement), rest);
  if (judgement.verdict == Verdict::worse)
    return fmt::format("Worse than what the robot carries: {}. Keep what it carries.{}", seen, rest);
  return fmt::format(
      "{}ot shown to be better than what the robot carries: {}. Keep what it carries.{}",
      judgement.within_drift ? "There is little to gain, because what was found differs from what the robot "
                               "carries by less than robots change from day to day: n"
      : judgement.within_errors_and_drift
          ? "What was found differs from what the robot carries by no more than these drives leave open and "
            "robots change by from day to day: n"
      : judgement.little_to_gain()
          ? "There is little to gain, because the robot carries what was found, within the error of "
            "these drives: n"
          : "N",
      seen, rest);
}

std::string judgement_sentence(const Calibration& found) {
  return found.scans() != nullptr ? verdict_sentence(*found.scans()) : judgement_sentence(found.judgement);
}

std::string drift_sentence(const calibration::DayDrift& drift) {
  const std::string ratios = fmt::format("E_d by {:.2g} %, S by {:.2g} % and b / S by {:.2g} %",
                                         100 * drift.E_d, 100 * drift.scale, 100 * drift.b_over_scale);
  if (drift.days < 2)
    return fmt::format(
        "From one day to another real robots change by about as much as this: {}, and e by {:.1g}. It is "
        "part of the errors on another day, and is taken from other robots, because these drives are not "
        "known to be of several days.",
        ratios, drift.e);
  return fmt::format(
      "From one day to another this robot changes by about as much as this: {}. It is part of the errors on "
      "another day, and was estimated from {} days and from other robots, which count like four. For e, "
      "{:.1g} is taken from other robots.",
      ratios, drift.days, drift.e);
}

std::string_view name_of(Verdict verdict) {
  for (const auto& [one, name] : kNames)
    if (one == verdict) return name;
  return "unknown";
}

Verdict verdict_named(std::string_view name) {
  for (const auto& [verdict, one] : kNames)
    if (one == name) return verdict;
  return Verdict::unknown;
}

bool advises_against(Verdict verdict) { return verdict == Verdict::worse || verdict == Verdict::undecided; }

}  // namespace astro::experiment
