#include "host/experiment/analysis/likelihood_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/calibration/judgement/remarks.hpp"

namespace astro::experiment {
namespace {

// A larger standard error of e is half of what is known without any drive.
constexpr double kHardlyShown = 0.01;

/// A remark with a capital letter, unless it begins with the name of a run, which stays as it is.
std::string capitalised(std::string remark, const std::vector<calibration::RunFit>& runs) {
  const bool named = std::any_of(runs.begin(), runs.end(),
                                 [&](const auto& run) { return remark.starts_with(run.name + ' '); });
  if (!named && !remark.empty() && remark[0] >= 'a' && remark[0] <= 'z')
    remark[0] = static_cast<char>(remark[0] - 'a' + 'A');
  return remark;
}

std::string place_text(const calibration::SessionFit& session) {
  const calibration::LeverArm &lever = session.lever, &se = session.lever_se;
  std::string text = fmt::format("x {} mm, y {} mm", with_error(1000 * lever.x_m, 1000 * se.x_m, 2),
                                 with_error(1000 * lever.y_m, 1000 * se.y_m, 2));
  if (std::isfinite(lever.theta_rad))
    text += fmt::format(", yaw {}°", with_error(degrees(lever.theta_rad), degrees(se.theta_rad), 3));
  return text;
}

/// The name of a session, or its runs: "run 1 and run 2", or the first and how many more.
std::string session_text(const MlResult& ml, int session) {
  const auto i = static_cast<std::size_t>(session);
  if (i < ml.session_names.size() && !ml.session_names[i].empty()) return "'" + ml.session_names[i] + "'";
  std::vector<std::string> names;
  for (const calibration::RunFit& run : ml.estimate.runs)
    if (run.session == session) names.push_back(run.name);
  if (names.size() > 2) return fmt::format("{} and {} more", names.front(), names.size() - 1);
  return fmt::format("{}", fmt::join(names, " and "));
}

/// Of a normal difference in standard errors: one in a hundred is larger.
constexpr double kUnlikely = 2.6;

}  // namespace

int decimals_by(double error, int decimals) {
  if (!std::isfinite(error) || !(error > 0)) return decimals;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9);
}

std::string with_error(double value, double error, int decimals) {
  if (!std::isfinite(error)) return fmt::format("{:.{}f}", without_minus_zero(value, decimals), decimals);
  decimals = decimals_by(error, decimals);
  return fmt::format("{:.{}f} ± {:.{}f}", without_minus_zero(value, decimals), decimals, error, decimals);
}

std::string extent_sentence(const MlResult& ml) {
  double distance_m = 0, rotation_rad = 0;
  for (const calibration::RunFit& run : ml.estimate.runs) {
    distance_m += run.distance_m;
    rotation_rad += run.rotation_rad;
  }
  return fmt::format("Maximum likelihood over {} {}drive{}: {:.1f} m and {:.1f} turns.",
                     ml.estimate.runs.size(), ml.estimate.ends_only ? "" : "whole ",
                     ml.estimate.runs.size() == 1 ? "" : "s", distance_m,
                     rotation_rad / (2 * std::numbers::pi));
}

std::string lever_sentence(const MlResult& ml) {
  const auto& sessions = ml.estimate.sessions;
  if (sessions.size() == 1)
    return "The tracked body sits at " + place_text(sessions.front()) +
           " on the robot (x ahead, y left of the midpoint between the wheels).";
  std::string text = fmt::format(
      "The drives are of {} sessions, between which the tracked body or the clocks were set up anew. On the "
      "robot (x ahead, y "
      "left of the midpoint between the wheels) it sits",
      sessions.size());
  for (std::size_t i = 0; i < sessions.size(); ++i)
    text += fmt::format("{} in {} at {}",
                        i == 0                     ? ""
                        : i + 1 == sessions.size() ? " and"
                                                   : ",",
                        session_text(ml, static_cast<int>(i)), place_text(sessions[i]));
  return text + '.';
}

std::string clock_sentence(const MlResult& ml) {
  if (ml.estimate.ends_only)
    return "Only the poses before and after each drive were measured, so the clocks do not matter.";
  if (ml.options.clock_known) return "The times of the ground truth are taken for the robot's own.";
  std::vector<std::string> rates;
  for (const calibration::SessionFit& session : ml.estimate.sessions)
    rates.push_back(fmt::format(
        "{} ppm {}", with_error(1e6 * std::abs(session.clock_skew), 1e6 * session.clock_skew_se, 1),
        session.clock_skew < 0 ? "slower" : "faster"));
  return fmt::format(
      "The robot's clock runs {} than that of the ground truth{}; the offset was found for each run.",
      fmt::join(rates, " and "), rates.size() > 1 ? ", in the order of the sessions" : "");
}

std::string scale_sentence(const Calibration& found) {
  if (found.truth_scale_sigma == 0) return "";
  if (std::isinf(found.truth_scale_sigma))
    return "Nobody measured a distance in the film, so the scale is not found: S is as loaded. E_d and b / S "
           "are found all the "
           "same.";
  const lidar::ScanCalibration* scans = found.scans();
  const calibration::MlErrors errors =
      scans == nullptr ? found.ml()->estimate.se : calibration::errors_of(scans->covariance, scans->factors);
  std::string loaded;
  if (std::isfinite(found.loaded_scale_sigma))
    loaded = fmt::format(" The loaded S is known to {:.2g} % and counts with that.",
                         100 * found.loaded_scale_sigma);
  if (found.loaded_scale_apart > kUnlikely)
    loaded += fmt::format(
        " It is {:.1f} standard errors from that of the scans, so one of the two is not known as well.",
        found.loaded_scale_apart);
  return fmt::format(
      "The scale of the {} is known to {:.2g} %, which is part of the errors of c_R, c_L, b and S; E_d and "
      "b / S do not depend on it (b / S {} mm).{}",
      scans == nullptr ? "ground truth" : "scanner's ranges", 100 * found.truth_scale_sigma,
      with_error(1000 * found.factors.b_m / found.scale(), 1000 * errors.b_over_scale_m, 3), loaded);
}

std::string wheelbases_text(const calibration::WheelFactors& factors) {
  return fmt::format("spins turn about b = {:.3f} mm, gentle arcs about b (1 + e) = {:.3f} mm",
                     1000 * factors.b_m, 1000 * factors.b_m * (1 + factors.e));
}

std::string wheelbase_sentence(const Calibration& found) {
  const calibration::WheelFactors& factors = found.factors;
  const std::string e = with_error(factors.e, found.se.e, 4);
  const auto shown = calibration::two_wheelbases(factors.e, found.se.e);
  if (shown == calibration::Shown::no)
    return fmt::format(
        "Whether gentle arcs turn about another wheelbase than spins the drives {}; e = {} is what they and "
        "the tyres of other robots make likely.",
        found.se.e > kHardlyShown ? "hardly show (squares and circles together would)" : "do not show", e);
  return fmt::format(
      "{} two wheelbases (e = {}): {}. With that of spins alone, odometry would turn a gentle arc up to "
      "{:.1f} % too {}.",
      shown == calibration::Shown::clearly ? "The robot has" : "Perhaps the robot has", e,
      wheelbases_text(factors), 100 * std::abs(factors.e), factors.e > 0 ? "far" : "little");
}

std::string noise_sentence(const MlResult& ml) {
  const calibration::NoiseModel& noise = ml.estimate.noise;
  const bool headings = std::isfinite(ml.estimate.sessions.front().lever.theta_rad);
  // How exact a person reads a tape, the two ends of a drive do not show.
  const bool assumed = ml.estimate.ends_only && !ml.noise_given;
  std::string text = fmt::format("Noise, {}: wheel slip K = {:.3g} m; ground truth{} {:.3g} mm",
                                 ml.noise_given ? "given" : "estimated", noise.K_m,
                                 assumed ? ", assumed as read from a tape:" : "", 1000 * noise.sigma_xy_m);
  if (headings) text += fmt::format(" and {:.3g} mrad", 1000 * noise.sigma_theta_rad);
  text += fmt::format(" {}. Chi-square per degree of freedom: {:.2f}.",
                      ml.estimate.ends_only ? "an end" : "a sample",
                      ml.estimate.chi_square / std::max(1, ml.estimate.degrees_of_freedom));
  if (ml.estimate.spacing_m > 0)
    text += fmt::format(
        " Ground truth was taken every {:.2g} m of the wheels' way: closer samples share errors that come "
        "and go (wheels out of "
        "round, tyres that give, times that jitter).",
        ml.estimate.spacing_m);
  for (const auto& [name, wheel] : {std::pair{"left", &ml.estimate.eccentricities.left},
                                    std::pair{"right", &ml.estimate.eccentricities.right}})
    if (wheel->significant)
      text += fmt::format(
          " The {} wheel runs {} mm out of true once per turn: its rim, its gear or its encoder sits off the "
          "axis.",
          name, with_error(1000 * wheel->amplitude_m, 1000 * wheel->standard_error_m, 2));
  return text;
}

std::vector<Remark> verdict(const MlResult& ml) {
  std::vector<Remark> remarks = calibration::remarks(ml.estimate, ml.noise_given);
  for (Remark& remark : remarks) remark.sentence = capitalised(std::move(remark.sentence), ml.estimate.runs);
  if (remarks.empty()) remarks.push_back({"The runs agree with each other"});
  return remarks;
}

}  // namespace astro::experiment
