#include "host/import/scans/scan_result.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "host/calibration/likelihood/day_drift.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/files/factors_json.hpp"

namespace astro::importing {
namespace {

using calibration::Verdict;
using lidar::ScanCalibration;

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

}  // namespace

double standard_error(const ScanCalibration& found, int index) {
  return std::sqrt(found.covariance(index, index));
}

double mean_scale(const calibration::WheelFactors& factors) { return (factors.c_r + factors.c_l) / 2; }
double diameter_ratio(const calibration::WheelFactors& factors) { return factors.c_r / factors.c_l; }

double diameter_ratio_error(const ScanCalibration& found) {
  const Eigen::Vector3d by{1 / found.factors.c_r, -1 / found.factors.c_l, 0};
  return std::sqrt(by.dot(found.covariance * by));
}

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
  json["standard_errors"] = {{"c_R", standard_error(found, 0)},
                             {"c_L", standard_error(found, 1)},
                             {"b_m", standard_error(found, 2)},
                             {"E_d", diameter_ratio_error(found)}};
  json["E_d"] = diameter_ratio(found.factors) / diameter_ratio(found.loaded);
  json["scale"] = mean_scale(found.factors);
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

}  // namespace astro::importing
