#include "host/commands/simulate/study_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/base/text/degrees.hpp"
#include "host/console/console.hpp"
#include "host/simulation/study/synthetic_drive.hpp"

namespace astro::commands {
namespace {

using nlohmann::json;
using simulation::study::Errors;
using simulation::study::Row;
using simulation::study::Summary;
using simulation::study::TrialSetup;

struct Column {
  const char *key, *heading, *unit;
  double per_unit;
};

constexpr std::array<Column, simulation::study::kFigures> kColumns = {
    {{"E_d", "E_d", "x1e-4", 1e4},
     {"b_over_S", "b/S", "x1e-4", 1e4},
     {"scale", "scale S", "x1e-4", 1e4},
     {"e", "e", "x1e-4", 1e4},
     {"E_max_m", "E_max", "mm", 1e3},
     {"theta_rad", "theta", "mrad", 1e3},
     {"line_10m_m", "10 m line", "mm", 1e3}}};

/// The figures that the study has.
std::vector<std::size_t> figures_of(const TrialSetup& setup) {
  std::vector<std::size_t> figures;
  for (std::size_t f = 0; f < simulation::study::kFigures; ++f)
    if (f != simulation::study::kCurvature || setup.shows_e()) figures.push_back(f);
  return figures;
}

/// What is not in every study: circles, and tyres with a width.
std::string tyres_text(const TrialSetup& setup) {
  std::string text;
  if (setup.shows_e())
    text += fmt::format("{0} + {0} circles of {1} turns, radius {2:g} m; e {3:g}\n", setup.circles,
                        simulation::study::kCircleTurns, setup.circle_radius_m, setup.e);
  if (setup.windup_rad > 0)
    text +=
        fmt::format("spins wind up {:g} mrad; a stand of {:g} s after each, a line of {:g} m at the end\n",
                    1000 * setup.windup_rad, simulation::study::kStand_s, simulation::study::kEndLine_m);
  return text;
}

std::string setup_text(const TrialSetup& setup) {
  return fmt::format(
      "{13}\n"
      "{0} + {0} squares of {1:g} m; b {2:g} m, E_d {3:g}, E_b {4:g}, scale {5:g}\n"
      "{14}"
      "slip {6:g} m; truth {7:g} Hz, {8:g} mm, {9:.3g} deg; counts {10:g} Hz\n"
      "clock {11}; noise {12} to ml\n",
      setup.runs, setup.side_m, setup.wheelbase_m, setup.E_d, setup.E_b, setup.scale, setup.noise.K_m,
      setup.truth_rate_hz, setup.noise.sigma_xy_m * 1000, degrees(setup.noise.sigma_theta_rad),
      setup.count_rate_hz, setup.clock_known ? "known" : "estimated",
      setup.noise_known ? "known" : "estimated",
      setup.model == simulation::study::Model::simulator ? "simulated robot: firmware, motors, encoders"
                                                         : "kinematic robot: wheels and noise alone",
      tyres_text(setup));
}

std::vector<std::string> cells(const Row& row, const std::vector<std::size_t>& figures) {
  std::vector<std::string> cells{row.name};
  for (const std::size_t f : figures) cells.push_back(three_digits(row.rms[f] * kColumns[f].per_unit));
  return cells;
}

// Of the figures that scatter at all, the one that is least certain.
double worst_relative_error(const std::vector<Row>& rows, const std::vector<std::size_t>& figures) {
  double worst = 0;
  for (const Row& row : rows)
    for (const std::size_t f : figures)
      if (row.rms[f] > 0) worst = std::max(worst, row.se[f] / row.rms[f]);
  return worst;
}

/// `title` and the parts, of which the fourth stands on a line of its own, because it has no room on the first.
std::string listed(const std::string& title, const std::vector<std::string>& parts) {
  std::string text = title;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? " " : i < 3 ? ", " : ",\n" + std::string(title.size() + 1, ' ')) + parts[i];
  return text + '\n';
}

std::string ml_text(const Summary& summary) {
  constexpr std::array kNames{"E_d", "b/S", "S", "e"};  // as in ml_over_bound
  std::vector<std::string> ratios, means;
  for (std::size_t i = 0; i < summary.ml_over_bound.size(); ++i) {
    const auto& [ratio, of_ratio] = summary.ml_over_bound[i];
    const auto& [mean, of_mean] = summary.ml_mean_errors[i];
    ratios.push_back(fmt::format("{} {:.3f} ± {:.3f}", kNames[i], ratio, of_ratio));
    means.push_back(fmt::format("{} {:+.2f} ± {:.2f}", kNames[i], 1e4 * mean, 1e4 * of_mean));
  }
  std::string text;
  if (!ratios.empty())
    text += listed("ml over the bound:", ratios) + listed("mean errors of ml, x1e-4:", means);
  if (const auto& consistency = summary.ml_covariance)
    text += fmt::format("chi-square of ml's errors by its own covariance: {:.3f} ± {:.3f}, expected {:.4g}\n",
                        consistency->mean, consistency->se, consistency->expected);
  if (summary.ml_median_K_m)
    text += fmt::format("slip that ml found: {:.3g} m (median), true {:g} m\n", *summary.ml_median_K_m,
                        summary.setup.noise.K_m);
  return text;
}

json figures(const Errors& values, const TrialSetup& setup) {
  json object;
  for (const std::size_t f : figures_of(setup)) object[kColumns[f].key] = values[f];
  return object;
}

json row_json(const Row& row, const TrialSetup& setup) {
  return {{"name", row.name},
          {"trials", row.trials},
          {"rms", figures(row.rms, setup)},
          {"se", figures(row.se, setup)}};
}

}  // namespace

std::string three_digits(double value) {
  if (!std::isfinite(value) || value == 0) return fmt::format("{:g}", value);
  const int before = static_cast<int>(std::floor(std::log10(std::abs(value) * (1 + 1e-9))));
  return fmt::format("{:.{}f}", value, std::clamp(2 - before, 0, 9));
}

std::string study_text(const Summary& summary) {
  const std::vector<std::size_t> figures = figures_of(summary.setup);
  std::vector<std::vector<std::string>> rows{{"rms errors"}, {""}};
  for (const std::size_t f : figures) {
    rows[0].emplace_back(kColumns[f].heading);
    rows[1].emplace_back(kColumns[f].unit);
  }
  for (const Row& row : summary.methods) rows.push_back(cells(row, figures));
  rows.push_back(cells(summary.bound, figures));
  std::string text = setup_text(summary.setup) + '\n' + console::table(rows) + '\n';
  text += fmt::format("{} trials: chance moves figures by up to {:.1f} % (one standard error)\n",
                      summary.setup.trials, 100 * worst_relative_error(summary.methods, figures));
  text += ml_text(summary);
  for (const std::string& failure : summary.failures) text += failure + '\n';
  return text;
}

json study_json(const Summary& summary) {
  const TrialSetup& setup = summary.setup;
  json result = {
      {"setup", to_json(setup)}, {"methods", json::array()},    {"bound", row_json(summary.bound, setup)},
      {"ml_over_bound", json()}, {"ml_mean_errors", json()},    {"ml_covariance", json()},
      {"ml_median_K_m", json()}, {"failures", summary.failures}};
  for (const Row& row : summary.methods) result["methods"].push_back(row_json(row, setup));
  if (summary.ml_median_K_m) result["ml_median_K_m"] = *summary.ml_median_K_m;
  for (std::size_t i = 0; i < summary.ml_over_bound.size(); ++i) {
    const auto& ratio = summary.ml_over_bound[i];
    const auto& mean = summary.ml_mean_errors[i];
    result["ml_over_bound"][kColumns[i].key] = {{"value", ratio.value}, {"se", ratio.se}};
    result["ml_mean_errors"][kColumns[i].key] = {{"value", mean.value}, {"se", mean.se}};
  }
  if (const auto& consistency = summary.ml_covariance)
    result["ml_covariance"] = {{"trials", consistency->trials},
                               {"mean", consistency->mean},
                               {"se", consistency->se},
                               {"expected", consistency->expected}};
  return result;
}

}  // namespace astro::commands
