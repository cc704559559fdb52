#include "host/wall/wall_judgement.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "host/calibration/judgement/cross_validation.hpp"

namespace astro::wall {
namespace {

/// The fit of all stretches but one. The stretch behind that one then shares no squaring with the one before.
HeadingFit without(std::size_t held_out, const WallEstimate& found, const calibration::WheelFactors& loaded) {
  std::vector<Stretch> others = found.stretches;
  if (held_out + 1 < others.size()) others[held_out + 1].first = true;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(held_out));
  return fit_headings(others, loaded, found.noise);
}

double error_rad(const Stretch& stretch, double a_right, double a_left) {
  return stretch.turned_rad - (a_right * stretch.travel.right_m - a_left * stretch.travel.left_m);
}

/// How much more likely a gap is with the scale of the other readings than with the loaded one.
void add_gaps(const WallDrive& drive, const WallEstimate& found, const calibration::WheelFactors& loaded,
              std::vector<double>& gains) {
  for (std::size_t series = 0; series < drive.size(); ++series) {
    for (std::size_t i = 0; i < drive[series].readings.size(); ++i) {
      WallDrive others = drive;
      others[series].readings.erase(others[series].readings.begin() + static_cast<std::ptrdiff_t>(i));
      const auto scale = scale_of_gaps(others, found.factors, found.noise);
      if (!scale) continue;
      const GapReading& reading = drive[series].readings[i];
      const WheelTravel since = reading.travel - drive[series].squarings[reading.squaring];
      const double mean = (found.factors.c_r + found.factors.c_l) / 2;
      const double driven_m = backed_off_m(since, found.factors) / mean;
      const double variance_m2 = found.noise.K_m * since.path_m() / 4 + std::pow(found.noise.reading_m, 2) +
                                 std::pow(found.noise.contact_m, 2);
      const double loaded_m = reading.gap_m - (loaded.c_r + loaded.c_l) / 2 * driven_m;
      const double found_m = reading.gap_m - scale->scale * driven_m;
      gains.push_back((loaded_m * loaded_m - found_m * found_m) / variance_m2);
    }
  }
}

}  // namespace

WallJudgement judge_wall(const WallDrive& drive, const WallEstimate& found,
                         const calibration::WheelFactors& loaded) {
  WallJudgement judgement;
  std::vector<double> gains;
  for (std::size_t i = 0; i < found.stretches.size(); ++i) {
    const Stretch& stretch = found.stretches[i];
    const HeadingFit others = without(i, found, loaded);
    const double by_loaded = error_rad(stretch, loaded.c_r / loaded.b_m, loaded.c_l / loaded.b_m);
    const double by_found = error_rad(stretch, others.a[0], others.a[1]);
    HeadingFit exact = others;
    exact.covariance.setZero();
    const double variance = heading_variance(stretch.travel, exact, found.noise);
    // If few laps were driven, the others may determine the factors too poorly to judge this stretch.
    constexpr double kVague = 10;
    if (heading_variance(stretch.travel, others, found.noise) > kVague * variance) continue;
    gains.push_back((by_loaded * by_loaded - by_found * by_found) / variance);
    constexpr double kTells = 0.1;  // standard deviations; a way to and fro tells no factors apart
    if (std::abs(by_loaded - by_found) < kTells * std::sqrt(variance)) continue;
    ++judgement.stretches;
    judgement.better_on += gains.back() > 0 ? 1 : 0;
    judgement.loaded_rad += by_loaded * by_loaded;
    judgement.found_rad += by_found * by_found;
  }
  const double count = std::max(judgement.stretches, 1);
  judgement.loaded_rad = std::sqrt(judgement.loaded_rad / count);
  judgement.found_rad = std::sqrt(judgement.found_rad / count);
  add_gaps(without_contradicted(drive, found.factors, found.noise), found, loaded, gains);
  judgement.verdict = judgement.stretches < WallJudgement::kFewest ? calibration::Verdict::unknown
                                                                   : calibration::judge_gains(gains);
  judgement.readings_contradict = found.scale && found.scale->contradictory();
  if (judgement.readings_contradict && judgement.verdict != calibration::Verdict::worse)
    judgement.verdict = calibration::Verdict::undecided;
  return judgement;
}

std::string WallJudgement::sentence() const {
  const std::string contradiction =
      readings_contradict ? " The readings of the ruler contradict each other, so the scale is not known."
                          : "";
  if (stretches < kFewest) return "Too few ways were driven to judge the new factors." + contradiction;
  const char* what = verdict == calibration::Verdict::better  ? "Better"
                     : verdict == calibration::Verdict::worse ? "Worse"
                                                              : "Not shown to be better";
  return fmt::format(
      "{}: on {} of {} ways that they had not seen the new factors fit better, and the heading at their ends "
      "is off by {:.0f} mrad instead of {:.0f} mrad.{}",
      what, better_on, stretches, 1000 * found_rad, 1000 * loaded_rad, contradiction);
}

}  // namespace astro::wall
