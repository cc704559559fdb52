#include "host/experiment/analysis/scan_sentences.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "host/base/pose2.hpp"
#include "host/base/text/degrees.hpp"

namespace astro::experiment {
namespace {

using calibration::Verdict;
using lidar::ScanCalibration;

/// "E_d and b / S", of a set as GE.
std::string factors_in(std::string_view set) {
  std::vector<std::string> names;
  for (const char one : set)
    names.emplace_back(one == 'S' ? "the scale" : one == 'G' ? "b / S with e" : "E_d");
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Verdict verdict_of(const ScanCalibration& found) {
  if (!found.judged) return Verdict::undecided;
  return found.choice.better() ? Verdict::better : found.choice.worse() ? Verdict::worse : Verdict::undecided;
}

std::string verdict_sentence(const ScanCalibration& found) {
  const lidar::FactorChoice& choice = found.choice;
  if (!lidar::can_be_judged(choice))
    return fmt::format(
        "Not shown to be better than what the robot carries, because the drives are too short to judge it: "
        "there are {} pieces of {:.1f} m in which the scans show the motion without a gap. Keep what it "
        "carries.",
        choice.pieces, choice.piece_m);
  if (!found.judged)
    return "Not shown to be better than what the robot carries, because without turns a mirror image of the "
           "scans would look the same. Keep what it carries.";
  const std::string seen = fmt::format(
      "on {} pieces of {:.1f} m that it had not seen, wheels and scans end {:.1f} mm apart instead of {:.1f} "
      "mm "
      "(root mean squares), and the typical error is {:.0f} % {} (standard error {:.0f} %)",
      choice.pieces, choice.piece_m, 1000 * choice.rms_m, 1000 * choice.loaded_rms_m,
      100 * std::abs(1 - std::exp(-choice.gain)), choice.gain < 0 ? "larger" : "smaller",
      100 * choice.gain_se);
  if (choice.better()) return fmt::format("Better than what the robot carries: {}, so use it.", seen);
  return fmt::format("{} what the robot carries: {}. Keep what it carries.",
                     choice.worse() ? "Worse than" : "Not shown to be better than", seen);
}

std::string matches_sentence(const ScanCalibration& found) {
  const double way_m = found.residuals.empty() ? 0 : found.residuals.back().way_m;
  return fmt::format("By {} scans along {:.0f} m, of which {} pairs were matched.", found.counts.scans, way_m,
                     found.counts.matched);
}

std::string scanner_sentence(const ScanCalibration& found) {
  std::string text = fmt::format(
      "The scanner sits {:.0f} mm ahead and {:.0f} mm to the left of the middle (± {:.0f} and {:.0f} mm) and "
      "looks {:.2f} degrees to the left (± {:.2f}).",
      1000 * found.scanner.x_m, 1000 * found.scanner.y_m, 1000 * found.scanner_se.x_m,
      1000 * found.scanner_se.y_m, degrees(wrapped_rad(found.scanner.theta_rad)),
      degrees(found.scanner_se.theta_rad));
  if (std::isfinite(found.late_se_s))
    text += fmt::format(" Its stamps are {:.1f} ms late (± {:.1f} ms).", 1000 * found.late_s,
                        1000 * found.late_se_s);
  return text;
}

std::string changed_sentence(const ScanCalibration& found) {
  if (found.choice.set.name.empty()) return "";
  return fmt::format(
      "These factors are from the drives alone, which helps on pieces that were not used to find them: {}.{}",
      factors_in(found.choice.set.name),
      found.choice.set.has_all()
          ? ""
          : " The others are moved as far as the drives show them better than the loaded ones are known.");
}

}  // namespace astro::experiment
