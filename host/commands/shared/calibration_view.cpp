#include "host/commands/shared/calibration_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/text/columns.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/experiment/analysis/scan_sentences.hpp"
#include "host/experiment/analysis/until.hpp"
#include "host/experiment/files/method_names.hpp"

namespace astro::commands {
namespace {

using experiment::Calibration;
using experiment::MlResult;
using experiment::with_error;
using Rows = std::vector<std::vector<std::string>>;

std::string known(double value, int decimals) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", without_minus_zero(value, decimals), decimals) : "-";
}

std::string percent(double ratio) {
  const double change = 100 * (ratio - 1);
  return std::abs(change) < 5e-5 ? "0" : fmt::format("{:+.4f} %", change);
}

std::string squares_text(const calibration::ExperimentSummary& squares) {
  const auto cluster = [](const char* name, const calibration::ClusterSummary& c) {
    return std::vector<std::string>{name,
                                    fmt::format("{}", c.runs),
                                    known(1000 * c.x_cg_m, 1),
                                    known(1000 * c.y_cg_m, 1),
                                    known(1000 * c.theta_cg_rad, 2),
                                    fmt::format("{:.1f}", 1000 * c.r_cg_m)};
  };
  return console::table({{"squares", "runs", "x_cg mm", "y_cg mm", "theta_cg mrad", "r_cg mm"},
                         cluster("cw", squares.cw),
                         cluster("ccw", squares.ccw)}) +
         fmt::format("E_max_syst {} mm\n",
                     with_error(1000 * squares.E_max_syst_m, 1000 * squares.se_E_max_syst_m, 1));
}

/// The factors, and how they differ from those that were loaded.
std::string factors_text(const Calibration& found) {
  const experiment::FactorErrors &se = found.se, &day = found.se_another_day;
  const calibration::WheelFactors &now = found.factors, &old = found.loaded;
  // With as many decimals as the factor beside it.
  const auto off = [](double error, double own, int decimals) {
    return std::isfinite(error) ? "± " + known(error, experiment::decimals_by(own, decimals)) : "";
  };
  Rows rows{{"", "", "another day", "against loaded"},
            {"c_R", with_error(now.c_r, se.c_r, 8), off(day.c_r, se.c_r, 6), percent(now.c_r / old.c_r)},
            {"c_L", with_error(now.c_l, se.c_l, 8), off(day.c_l, se.c_l, 6), percent(now.c_l / old.c_l)},
            {"b mm", with_error(1000 * now.b_m, 1000 * se.b_m, 4), off(1000 * day.b_m, 1000 * se.b_m, 3),
             percent(now.b_m / old.b_m)}};
  if (found.shows_e())
    rows.push_back(
        {"e", with_error(now.e, se.e, 6), off(day.e, se.e, 4), fmt::format("{:+.6f}", now.e - old.e)});
  rows.insert(rows.end(), {{"S", with_error(found.scale(), se.scale, 8), off(day.scale, se.scale, 6),
                            percent(found.scale_change())},
                           {"E_d", with_error(found.E_d(), se.E_d, 7), off(day.E_d, se.E_d, 6), ""},
                           {"E_b", with_error(found.E_b(), se.E_b, 7), off(day.E_b, se.E_b, 6), ""}});
  return console::table(rows);
}

std::string scale_text(const Calibration& calibration) {
  const auto& scale = calibration.line_scale;
  if (!scale) return "S is as loaded: closed squares do not show it, and no line was measured.";
  return fmt::format("S is from {} measured line{}.", scale->lines, scale->lines == 1 ? "" : "s");
}

std::string left_out_text(const Calibration& calibration) {
  std::string text;
  for (const std::string& square : calibration.left_out) text += wrapped(square + '.');
  return text;
}

std::string misfit_text(const Calibration& calibration) {
  return calibration.misfit ? wrapped("Take care: " + calibration.misfit->sentence + '.') : "";
}

std::string end_pose_text(const calibration::Estimate& estimate) {
  return console::table(
      {{"method", std::string(calibration::name_of(estimate.options.method))},
       {"alpha", fmt::format("{:.5f}°", without_minus_zero(degrees(estimate.alpha_rad), 5))},
       {"beta", fmt::format("{:.5f}°", without_minus_zero(degrees(estimate.beta_rad), 5))},
       {"R", fmt::format("{:.3f} m", estimate.radius_m)}});
}

std::string sentence_on_scale(const Calibration& found) {
  const std::string sentence = experiment::scale_sentence(found);
  return sentence.empty() ? "" : wrapped(sentence);
}

std::string runs_text(const MlResult& ml) {
  Rows rows{{"run", "metres", "degrees", "chi²/dof", "disagrees"}};
  if (!ml.options.clock_known) rows[0].push_back("offset ms");
  for (const calibration::RunFit& run : ml.estimate.runs) {
    rows.push_back(
        {run.name, fmt::format("{:.2f}", run.distance_m), fmt::format("{:.0f}", degrees(run.rotation_rad)),
         fmt::format("{:.2f}", run.chi_square / std::max(1, run.degrees_of_freedom)),
         run.disagreement_dof > 0 ? fmt::format("{:.1f} of {}", run.disagreement, run.disagreement_dof)
                                  : std::string("-")});
    if (!ml.options.clock_known)
      rows.back().push_back(with_error(1000 * run.clock_offset_s, 1000 * run.clock_offset_se_s, 2));
    if (run.outlier) rows.back().push_back("outlier");
  }
  return console::table(rows);
}

std::string motions_text(const calibration::MlEstimate& estimate) {
  if (estimate.kinds.empty()) return "";  // only ends were measured
  Rows rows{{"motion", "samples", "metres", "degrees", "rms mm", "rms mrad", "chi²/dof"}};
  for (const calibration::KindFit& kind : estimate.kinds)
    rows.push_back({std::string(experiment::name_of(kind.motion)), fmt::format("{}", kind.samples),
                    fmt::format("{:.2f}", kind.distance_m), fmt::format("{:.0f}", degrees(kind.rotation_rad)),
                    known(1000 * kind.rms_xy_m, 2), known(1000 * kind.rms_theta_rad, 2),
                    fmt::format("{:.2f}", kind.chi_square_per_dof)});
  return console::table(rows) + '\n';
}

std::string verdict_text(const MlResult& ml) {
  std::string text;
  for (const Remark& remark : experiment::verdict(ml)) text += wrapped(in_words(remark) + '.');
  return text;
}

std::string ml_text(const Calibration& found) {
  const MlResult& ml = *found.ml();
  std::string text;
  for (const std::string& sentence : {experiment::lever_sentence(ml), experiment::clock_sentence(ml),
                                      experiment::wheelbase_sentence(found), experiment::noise_sentence(ml)})
    text += wrapped(sentence);
  text += '\n' + runs_text(ml) + '\n' + motions_text(ml.estimate);
  text += verdict_text(ml);
  return text;
}

std::string scans_text(const Calibration& found) {
  const lidar::ScanCalibration& scans = *found.scans();
  std::string text = wrapped(experiment::scanner_sentence(scans));
  if (const std::string changed = experiment::changed_sentence(scans); !changed.empty())
    text += wrapped(changed);
  text += wrapped(experiment::wheelbase_sentence(found));
  for (const Remark& remark : scans.remarks) text += wrapped("Take care: " + in_words(remark) + '.');
  return text;
}

}  // namespace

std::string calibration_text(const Calibration& calibration) {
  std::string text;
  if (calibration.squares) text += squares_text(*calibration.squares) + '\n';
  if (const calibration::Estimate* estimate = calibration.end_poses()) text += end_pose_text(*estimate);
  const MlResult* ml = calibration.ml();
  if (ml != nullptr) text += wrapped(experiment::extent_sentence(*ml));
  const lidar::ScanCalibration* scans = calibration.scans();
  if (scans != nullptr) text += wrapped(experiment::matches_sentence(*scans));
  text += factors_text(calibration);
  if (ml != nullptr || scans != nullptr) text += sentence_on_scale(calibration);
  text += ml != nullptr ? '\n' + ml_text(calibration)
          : scans != nullptr
              ? '\n' + scans_text(calibration)
              : wrapped(scale_text(calibration)) + left_out_text(calibration) + misfit_text(calibration);
  return text + '\n' + wrapped(experiment::drift_sentence(calibration.drift)) +
         wrapped(experiment::judgement_sentence(calibration));
}

std::string calibration_summary(const Calibration& calibration) {
  const std::string precision =
      "Standard errors of these drives: " + experiment::described(experiment::precision_of(calibration)) +
      ".";
  if (const lidar::ScanCalibration* scans = calibration.scans())
    return wrapped(experiment::matches_sentence(*scans)) + wrapped(precision) +
           sentence_on_scale(calibration) + scans_text(calibration) +
           wrapped(experiment::drift_sentence(calibration.drift)) +
           wrapped(experiment::judgement_sentence(calibration));
  const MlResult* ml = calibration.ml();
  if (ml == nullptr)
    return fmt::format("calibrated by {}:\n", calibration.method()) + left_out_text(calibration) +
           wrapped(scale_text(calibration)) + misfit_text(calibration) +
           wrapped(experiment::judgement_sentence(calibration));
  std::string text = wrapped(experiment::extent_sentence(*ml)) + wrapped(precision) +
                     wrapped(experiment::drift_sentence(calibration.drift)) +
                     wrapped(experiment::wheelbase_sentence(calibration)) + sentence_on_scale(calibration);
  text += verdict_text(*ml);
  return text + wrapped(experiment::judgement_sentence(calibration));
}

}  // namespace astro::commands
