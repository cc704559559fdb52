#include "host/commands/calibrate/scan_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <vector>

#include "host/base/text/columns.hpp"
#include "host/base/text/degrees.hpp"
#include "host/calibration/likelihood/day_drift.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/experiment/files/factors_json.hpp"

namespace astro::commands {
namespace {

using calibration::Verdict;
using lidar::ScanCalibration;

double deviation(const ScanCalibration& found, int index) {
  return std::sqrt(found.covariance(index, index));
}

double ratio(const calibration::WheelFactors& factors) { return factors.c_r / factors.c_l; }
double scale(const calibration::WheelFactors& factors) { return (factors.c_r + factors.c_l) / 2; }

/// Relative, of c_R / c_L.
double ratio_error(const ScanCalibration& found) {
  const Eigen::Vector3d by{1 / found.factors.c_r, -1 / found.factors.c_l, 0};
  return std::sqrt(by.dot(found.covariance * by));
}

/// Of c_R, c_L, b and e: what these drives leave open, and what robots change by. Scans do not separate e from b.
calibration::FactorCovariance covariance_another_day(const ScanCalibration& found) {
  calibration::DayDrift drift;
  drift.e = calibration::PriorOfE::kStandardDeviation;
  calibration::FactorCovariance covariance = drift.covariance(found.factors);
  covariance.topLeftCorner<3, 3>() += found.covariance;
  return covariance;
}

std::map<std::string, double> values_of(const calibration::WheelFactors& factors) {
  return {{"c_R", factors.c_r},
          {"c_L", factors.c_l},
          {"b", factors.b_m},
          {"e", factors.e},
          {"kappa0", factors.kappa0}};
}

/// "E_d and b", of a set as SGE.
std::string factors_in(std::string_view set) {
  std::vector<std::string> names;
  for (const char one : set) names.emplace_back(one == 'S' ? "the scale" : one == 'G' ? "b / S" : "E_d");
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

experiment::ParameterFile parameter_file_of(const ScanCalibration& found,
                                            const std::optional<experiment::NominalWheel>& wheel) {
  experiment::ParameterFile file;
  for (const auto& [name, value] : values_of(found.factors)) file.parameters[name] = value;
  file.loaded = values_of(found.loaded);
  const calibration::FactorCovariance covariance = covariance_another_day(found);
  file.standard_errors = {{"c_R", std::sqrt(covariance(0, 0))},
                          {"c_L", std::sqrt(covariance(1, 1))},
                          {"b", std::sqrt(covariance(2, 2))},
                          {"e", std::numeric_limits<double>::quiet_NaN()}};
  file.absolute = true;
  file.wheel = wheel;
  file.covariance = covariance;
  file.method = "scan";
  file.verdict = verdict_of(found);
  file.verdict_sentence = verdict_sentence(found);
  return file;
}

nlohmann::json to_json(const ScanCalibration& found) {
  const lidar::ScanCounts& counts = found.counts;
  const lidar::FactorChoice& choice = found.choice;
  nlohmann::json json = experiment::to_json(found.factors);
  json["method"] = "scan";
  json["standard_errors"] = {{"c_R", deviation(found, 0)},
                             {"c_L", deviation(found, 1)},
                             {"b_m", deviation(found, 2)},
                             {"E_d", ratio_error(found)}};
  json["E_d"] = ratio(found.factors) / ratio(found.loaded);
  json["scale"] = scale(found.factors);
  json["loaded"] = experiment::to_json(found.loaded);
  json["scanner"] = {{"x_m", found.scanner.x_m},
                     {"y_m", found.scanner.y_m},
                     {"yaw_rad", wrapped_rad(found.scanner.theta_rad)},
                     {"se",
                      {{"x_m", found.scanner_se.x_m},
                       {"y_m", found.scanner_se.y_m},
                       {"yaw_rad", found.scanner_se.theta_rad}}}};
  const bool timed = std::isfinite(found.late_se_s);
  json["late_s"] = timed ? experiment::number(found.late_s) : nlohmann::json();
  json["late_se_s"] = experiment::number(found.late_se_s);
  json["scans"] = {{"read", counts.scans},          {"outside", counts.outside},
                   {"matched", counts.matched},     {"one_direction", counts.degenerate},
                   {"unmatched", counts.unmatched}, {"gaps", counts.gaps}};
  json["remarks"] = nlohmann::json::array();
  for (const Remark& remark : found.remarks) json["remarks"].push_back(remark.sentence);
  json["verdict"] = {{"verdict", experiment::name_of(verdict_of(found))},
                     {"sentence", verdict_sentence(found)},
                     {"factors", choice.set.name},
                     {"pieces", choice.pieces},
                     {"piece_m", choice.piece_m},
                     {"gain", experiment::number(choice.gain)},
                     {"gain_se", experiment::number(choice.gain_se)},
                     {"rms_m", experiment::number(choice.rms_m)},
                     {"loaded_rms_m", experiment::number(choice.loaded_rms_m)}};
  return json;
}

std::string scan_result_text(const ScanCalibration& found) {
  using experiment::with_error;
  const calibration::WheelFactors &factors = found.factors, &loaded = found.loaded;
  const std::vector<std::vector<std::string>> rows{
      {"", "loaded", "found"},
      {"c_R", fmt::format("{:.8f}", loaded.c_r), with_error(factors.c_r, deviation(found, 0), 8)},
      {"c_L", fmt::format("{:.8f}", loaded.c_l), with_error(factors.c_l, deviation(found, 1), 8)},
      {"b mm", fmt::format("{:.4f}", 1000 * loaded.b_m),
       with_error(1000 * factors.b_m, 1000 * deviation(found, 2), 4)},
      {"E_d", fmt::format("{:.7f}", ratio(loaded)),
       with_error(ratio(factors), ratio(factors) * ratio_error(found), 7)},
      {"S", fmt::format("{:.8f}", scale(loaded)), fmt::format("{:.8f}", scale(factors))}};
  const lidar::ScanCounts& counts = found.counts;
  std::string text = fmt::format(
      "{} scans, of which {} pairs were matched. The scanner sits {:.0f} mm ahead and {:.0f} mm to the left "
      "of "
      "the middle (± {:.0f} and {:.0f} mm) and looks {:.2f} degrees to the left (± {:.2f}).",
      counts.scans, counts.matched, 1000 * found.scanner.x_m, 1000 * found.scanner.y_m,
      1000 * found.scanner_se.x_m, 1000 * found.scanner_se.y_m, degrees(wrapped_rad(found.scanner.theta_rad)),
      degrees(found.scanner_se.theta_rad));
  if (std::isfinite(found.late_se_s))
    text += fmt::format(" Its stamps are {:.1f} ms late (± {:.1f} ms).", 1000 * found.late_s,
                        1000 * found.late_se_s);
  if (!found.choice.set.name.empty())
    text +=
        fmt::format(" These factors help on pieces that were not used to find them, and were changed: {}.",
                    factors_in(found.choice.set.name));
  return console::table(rows) + '\n' + wrapped(text) + wrapped(verdict_sentence(found));
}

}  // namespace astro::commands
