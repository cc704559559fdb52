#include "host/wall/wall_calibration.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/files/factors_json.hpp"

namespace astro::wall {
namespace {

double deviation(const WallEstimate& found, int index) { return std::sqrt(found.covariance(index, index)); }

/// Of c_R, c_L, b and e on another day. Laps in front of a wall do not show e.
calibration::FactorCovariance covariance_another_day(const WallEstimate& found) {
  calibration::DayDrift drift;
  if (!found.scale) drift.scale = 0;
  drift.e = calibration::PriorOfE::kStandardDeviation;
  calibration::FactorCovariance covariance = drift.covariance(found.factors);
  covariance.topLeftCorner<3, 3>() += found.covariance;
  return covariance;
}

}  // namespace

experiment::ParameterFile parameter_file_of(const WallResult& result, const WallJudgement& judgement) {
  const WallEstimate& found = result.estimate;
  const calibration::WheelFactors &factors = found.factors, &loaded = result.journal.loaded;
  experiment::ParameterFile file;
  file.parameters = {{"c_R", factors.c_r},
                     {"c_L", factors.c_l},
                     {"b", factors.b_m},
                     {"e", factors.e},
                     {"kappa0", factors.kappa0}};
  file.loaded = {{"c_R", loaded.c_r},
                 {"c_L", loaded.c_l},
                 {"b", loaded.b_m},
                 {"e", loaded.e},
                 {"kappa0", loaded.kappa0}};
  const calibration::FactorCovariance covariance = covariance_another_day(found);
  file.standard_errors = {{"c_R", std::sqrt(covariance(0, 0))},
                          {"c_L", std::sqrt(covariance(1, 1))},
                          {"b", std::sqrt(covariance(2, 2))},
                          {"e", std::numeric_limits<double>::quiet_NaN()}};
  // Without a ruler the scale is the loaded one, and is as good as that was.
  file.absolute = found.scale.has_value();
  file.wheel = experiment::NominalWheel{
      result.robot.wheel_diameter_m, std::numbers::pi * result.robot.wheel_diameter_m / result.robot.count_m};
  if (found.scale) file.covariance = covariance;
  file.slip_K_m = found.noise.K_m;
  file.robot = result.journal.robot;
  file.method = "wall";
  file.verdict = judgement.verdict;
  file.verdict_sentence = judgement.sentence();
  return file;
}

nlohmann::json to_json(const WallResult& result, const WallJudgement& judgement) {
  const WallEstimate& found = result.estimate;
  nlohmann::json json = experiment::to_json(found.factors);
  json["method"] = "wall";
  json["se"] = {{"c_R", deviation(found, 0)}, {"c_L", deviation(found, 1)},
                {"b_m", deviation(found, 2)}, {"E_d", found.se.E_d},
                {"b_ratio", found.se.b},      {"scale", experiment::number(found.se.scale)}};
  json["E_d"] = found.E_d;
  json["b_per_scale_m"] = found.b_per_scale_m;
  json["scale"] = found.scale ? experiment::number(found.scale->scale) : nlohmann::json();
  json["readings"] = found.scale ? found.scale->readings : 0;
  json["loaded"] = experiment::to_json(result.journal.loaded);
  json["K_m"] = found.noise.K_m;
  json["squaring_rad"] = found.noise.squaring_rad;
  json["squarings"] = found.stretches.size() + result.journal.drive.size();
  json["driven_s"] = result.journal.driven_s;
  json["precise"] = result.reached;
  if (result.gyro) json["gyro"] = experiment::to_json(*result.gyro);
  json["verdict"] = experiment::name_of(judgement.verdict);
  json["sentence"] = judgement.sentence();
  return json;
}

}  // namespace astro::wall
