#include "host/report/comparison.hpp"

#include <fmt/core.h>

#include <cmath>
#include <optional>
#include <string>

#include "host/report/numbers.hpp"

namespace astro::report {

using calibration::FigureOfMerit;
using calibration::Improvement;
using calibration::Verdict;

std::string verdict_sentence(const FigureOfMerit& before, const FigureOfMerit& after) {
  const double difference = before.value - after.value;
  const double error = std::hypot(before.standard_error, after.standard_error);
  const std::string change = fmt::format(
      "The largest systematic error {} from {} mm to {} mm", difference >= 0 ? "fell" : "rose",
      with_error(before.value, before.standard_error, 1), with_error(after.value, after.standard_error, 1));
  const std::string by = error > 0 ? fmt::format("{} standard errors", fixed(std::abs(difference) / error, 1))
                                   : "far beyond the scatter";
  switch (calibration::judge(before, after)) {
    case Verdict::better:
      return fmt::format("{}; the difference ({}) is significant at the 5 % level.", change, by);
    case Verdict::worse:
      return fmt::format("{}: the robot got worse, and the difference ({}) is significant at the 5 % level.",
                         change, by);
    case Verdict::undecided: {
      const std::optional<int> enough = calibration::runs_to_tell(before, after);
      return fmt::format(
          "{}, but the difference ({}) is not significant at the 5 % level: with so few runs it may be "
          "chance{}.",
          change, error > 0 ? by : "none",
          enough ? fmt::format("; {} in each direction would tell", *enough) : "");
    }
    case Verdict::unknown:
      break;
  }
  return change +
         "; one run per direction says nothing about the scatter, so whether that is chance stays open.";
}

std::string claim(const Improvement& improvement) {
  const bool bounded = !std::isinf(improvement.high);
  if (improvement.low <= 1 && !(improvement.high < 1)) return "not certainly changed";
  const double factor = bounded ? improvement.factor : improvement.low;
  const double size = factor >= 1 ? factor : 1 / factor;
  return fmt::format("{}{} times {}", bounded ? "" : "at least ", fixed(size, factor_decimals(size)),
                     factor >= 1 ? "smaller" : "larger");
}

std::string describe(const Improvement& improvement) {
  const auto digits = [](double value) { return fixed(value, factor_decimals(value)); };
  const std::string value = digits(improvement.factor);
  if (!std::isfinite(improvement.low)) return value;
  if (!std::isfinite(improvement.high)) {
    return fmt::format("{} (95 %: at least {})", value, digits(improvement.low));
  }
  return fmt::format("{} ± {} (95 %: {} to {})", value,
                     fixed(improvement.standard_error, factor_decimals(improvement.factor)),
                     digits(improvement.low), digits(improvement.high));
}

}  // namespace astro::report
