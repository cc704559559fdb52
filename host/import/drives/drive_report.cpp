#include "host/import/drives/drive_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/fixed/wrapping.hpp"
#include "host/calibration/motion/arc.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/likelihood_sentences.hpp"
#include "host/experiment/analysis/trajectories.hpp"

namespace astro::importing {
namespace {

using calibration::WheelFactors;

/// Converts the truth to poses of the robot's centre on the robot's clock, so that figures compare the same
/// thing.
void place_on_robot(recording::Run& run, const calibration::RunFit& fit, double skew,
                    const calibration::LeverArm& lever) {
  // The skew has no effect in the middle of the wheels' recording (calibration::PreparedRun).
  const std::int64_t middle_us = run.odometry.front().time_us +
                                 (run.odometry.back().time_us - run.odometry.front().time_us) / 2 -
                                 std::llround(1e6 * fit.clock_offset_s);
  for (recording::TruthSample& sample : run.truth) {
    const double since_middle_us = static_cast<double>(sample.time_us - middle_us);
    sample.time_us += std::llround(1e6 * fit.clock_offset_s + skew * since_middle_us);
    if (!std::isfinite(lever.theta_rad)) continue;  // without headings the lever arm is not known
    const Pose2 robot = pose_of(sample) * lever.inverse();
    sample.x_m = robot.x_m;
    sample.y_m = robot.y_m;
    sample.theta_rad = robot.theta_rad;
  }
}

/// Replaces the odometry by that with these factors.
void dead_reckon_again(recording::Run& run, const experiment::NominalWheel& wheel,
                       const WheelFactors& factors) {
  run.info.parameters["c_R"] = factors.c_r;
  run.info.parameters["c_L"] = factors.c_l;
  run.info.parameters["b"] = factors.b_m;
  run.info.parameters["e"] = factors.e;
  run.info.parameters["kappa0"] = factors.kappa0;
  const double metres = wheel.metres_per_count();
  Pose2 at;
  for (std::size_t i = 0; i < run.odometry.size(); ++i) {
    recording::OdometrySample& sample = run.odometry[i];
    const recording::OdometrySample& before = run.odometry[i == 0 ? 0 : i - 1];
    calibration::advance(at, metres * wrapping_difference(sample.right_counts, before.right_counts),
                         metres * wrapping_difference(sample.left_counts, before.left_counts), factors);
    sample.x_m = at.x_m;
    sample.y_m = at.y_m;
    sample.theta_rad = at.theta_rad;
  }
}

report::Phase phase_of(const std::string& title, std::vector<recording::Run> runs,
                       const WheelFactors& factors, bool with_e) {
  report::Phase phase;
  phase.title = title;
  phase.runs = std::move(runs);
  phase.loaded = {{factors.c_r}, {factors.c_l}, {factors.b_m}};
  if (with_e) phase.loaded.push_back({factors.e});
  return phase;
}

report::ReportInput outline(const experiment::RunSet& set, const experiment::Calibration& found,
                            const std::string& title, const WheelFactors& factors,
                            const experiment::FactorErrors& se) {
  const experiment::MlResult& ml = *found.ml();
  std::vector<recording::Run> runs = set.runs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].info.index = static_cast<int>(i) + 1;
    const auto fit = std::find_if(ml.estimate.runs.begin(), ml.estimate.runs.end(),
                                  [&](const calibration::RunFit& one) { return one.name == set.names[i]; });
    if (fit == ml.estimate.runs.end()) continue;
    const calibration::SessionFit& session = ml.estimate.sessions.at(static_cast<std::size_t>(fit->session));
    place_on_robot(runs[i], *fit, session.clock_skew, session.lever);
  }
  report::ReportInput input;
  const std::string& robot = found.robot.name;
  input.title = "Odometry calibration" + (robot.empty() ? "" : " of " + robot);
  input.description = {{"Robot", robot.empty() ? "not named in the files" : robot},
                       {"Nominal wheel", found.wheel ? found.wheel->described() : ""},
                       {"Drives", fmt::format("{}", runs.size())}};
  const bool with_e = found.loaded.e != 0 || factors.e != 0;
  input.phases.push_back(phase_of("carried", runs, found.loaded, with_e));
  for (recording::Run& run : runs) dead_reckon_again(run, experiment::nominal_wheel(run.info, ""), factors);
  input.phases.push_back(phase_of(title, std::move(runs), factors, with_e));
  input.parameters = {{"c_R", "", found.loaded.c_r, factors.c_r, se.c_r},
                      {"c_L", "", found.loaded.c_l, factors.c_l, se.c_l},
                      {"b", "m", found.loaded.b_m, factors.b_m, se.b_m}};
  if (with_e) input.parameters.push_back({"e", "", found.loaded.e, factors.e, se.e});
  input.method = experiment::extent_sentence(ml) + ' ' + experiment::lever_sentence(ml) + ' ' +
                 experiment::clock_sentence(ml) + "\n\n" + experiment::wheelbase_sentence(found) + ' ' +
                 experiment::scale_sentence(found) + ' ' + experiment::noise_sentence(ml);
  return input;
}

report::DriveFigures figures_of(const calibration::RunErrors& errors) {
  return {errors.final_m, errors.final_heading_rad, errors.path_rms_m};
}
report::DriveFigures figures_of(const calibration::HeldOutErrors& errors) {
  return {errors.final_m, errors.final_heading_rad, errors.path_m};
}
report::DriveFigures figures_of(const calibration::PathErrors& errors) {
  return {errors.final_rms_m, errors.final_heading_rms_rad, errors.path_rms_m};
}

}  // namespace

report::ReportInput drive_report(const experiment::RunSet& set, const experiment::Calibration& found) {
  report::ReportInput input = outline(set, found, "calibrated", found.factors, found.se);
  report::DriveComparison comparison{experiment::judgement_sentence(found), {}, {}, {}};
  for (const calibration::HeldOutRun& run : found.judgement.runs)
    comparison.drives.push_back({run.found.name, figures_of(run.in_use), figures_of(run.found)});
  comparison.before = figures_of(found.judgement.in_use());
  comparison.after = figures_of(found.judgement.found());
  input.comparison = std::move(comparison);
  return input;
}

report::ReportInput drive_report(const experiment::RunSet& set, const experiment::Calibration& found,
                                 const experiment::NamedFactors& factors) {
  report::ReportInput input = outline(set, found, "with " + factors.name, factors.factors, {});
  const std::array<experiment::NamedFactors, 2> both{experiment::NamedFactors{"carried", found.loaded},
                                                     factors};
  const std::vector<experiment::DeadReckoning> judged = experiment::dead_reckon(set, both);
  const calibration::PathErrors &before = judged[0].errors, &after = judged[1].errors;
  report::DriveComparison comparison{
      fmt::format(
          "With {} the end error is {:.1f} mm instead of {:.1f} mm and the path error {:.1f} mm instead of "
          "{:.1f} mm (root mean squares over {} drives).",
          factors.name, 1000 * after.final_rms_m, 1000 * before.final_rms_m, 1000 * after.path_rms_m,
          1000 * before.path_rms_m, after.runs.size()),
      {},
      figures_of(before),
      figures_of(after)};
  for (std::size_t i = 0; i < after.runs.size(); ++i)
    comparison.drives.push_back(
        {after.runs[i].name, figures_of(before.runs.at(i)), figures_of(after.runs[i])});
  input.comparison = std::move(comparison);
  return input;
}

}  // namespace astro::importing
