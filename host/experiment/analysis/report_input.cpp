#include "host/experiment/analysis/report_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <vector>

#include "host/base/error.hpp"
#include "host/experiment/analysis/gyro_runs.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/analysis/method_text.hpp"
#include "host/experiment/analysis/scan_figures.hpp"
#include "host/experiment/analysis/scanned_runs.hpp"
#include "host/recording/run_metadata.hpp"

namespace astro::experiment {
namespace {

using Row = report::DescriptionRow;

std::string squares_text(const Results& results) {
  std::string text;
  for (const PhaseResult& phase : results.phases)
    text += fmt::format("{}{}: {} clockwise and {} counter-clockwise", text.empty() ? "" : "; ", phase.name,
                        phase.summary.cw.runs, phase.summary.ccw.runs);
  return fmt::format("side {} m; {}", results.journal.plan.side_m, text);
}

std::vector<Row> description_of(const Results& results) {
  const Journal& journal = results.journal;
  std::vector<Row> rows{
      {"Robot", journal.robot_name},
      {"Unique id", journal.robot_id},
      {"Board", journal.board},
      {"Firmware", journal.firmware},
      {"Started", journal.started_at},
      {"Ground truth", journal.plan.truth},
      {"Squares", squares_text(results)},
      {"Speed", fmt::format("{} m/s, {} rad/s", journal.plan.speed_mps, journal.plan.yaw_rate_radps)}};
  if (journal.plan.until)
    rows.push_back({"Driven until", fmt::format("the standard errors of E_d, S and b are at most {:.3g} %",
                                                100 * journal.plan.until->target)});
  return rows;
}

/// The factors loaded in phase `i`, with the errors of the calibration that it comes from.
std::vector<report::LoadedValue> loaded_of(const Results& results, std::size_t i, bool shows_e) {
  const calibration::WheelFactors& loaded = results.phases[i].squares().loaded;
  const FactorErrors unknown;
  const bool found = i > 0 && results.phases[i - 1].calibration.has_value();
  const FactorErrors& se = found ? results.phases[i - 1].calibration->se_another_day : unknown;
  std::vector<report::LoadedValue> values{{loaded.c_r, se.c_r}, {loaded.c_l, se.c_l}, {loaded.b_m, se.b_m}};
  if (shows_e) values.push_back({loaded.e, se.e});
  return values;
}

std::span<const PhaseResult> calibrated_phases(const Results& results) {
  return std::span(results.phases).first(results.phases.size() - (results.not_loaded() != nullptr ? 0 : 1));
}

/// What the gyro of the robot showed in the phases from which the last calibration was found.
std::vector<std::string> gyro_notes(const Results& results, const Calibration& found) {
  std::vector<std::string> notes;
  for (const PhaseResult& phase : calibrated_phases(results)) try {
      if (const auto gyro = calibrate_gyro(phase.recordings->set(), found))
        std::ranges::move(notes_of(*gyro), std::back_inserter(notes));
    } catch (const Error& error) {
      notes.push_back(error.in("The gyro is not calibrated: ").sentence + '.');
    }
  return notes;
}

/// The drives from which the last calibration was found.
std::vector<lidar::ScannedDrive> drives_before(const Results& results) {
  std::vector<lidar::ScannedDrive> drives;
  for (const PhaseResult& phase : calibrated_phases(results))
    std::ranges::move(scanned_drives(phase.recordings->set()), std::back_inserter(drives));
  return drives;
}

}  // namespace

report::ReportInput report_input(const Results& results) {
  report::ReportInput input;
  input.title = "Odometry calibration of " + results.journal.robot_name;
  input.description = description_of(results);
  const calibration::WheelFactors& old = results.before().squares().loaded;
  const Calibration* const not_loaded = results.not_loaded();
  const Calibration* const found = not_loaded != nullptr ? not_loaded : results.last_calibration();
  const calibration::WheelFactors& now =
      not_loaded != nullptr ? not_loaded->factors : results.after().squares().loaded;
  const FactorErrors se = found != nullptr ? found->se_another_day : FactorErrors{};
  const bool shows_e = results.shows_e() || now.e != 0;
  for (std::size_t i = 0; i < results.phases.size(); ++i) {
    const PhaseResult& phase = results.phases[i];
    input.phases.push_back({phase.name, phase.runs(), phase.summary, phase.squares().cw, phase.squares().ccw,
                            loaded_of(results, i, shows_e)});
  }
  input.parameters = {{"c_R", "", old.c_r, now.c_r, se.c_r},
                      {"c_L", "", old.c_l, now.c_l, se.c_l},
                      {"b", "m", old.b_m, now.b_m, se.b_m}};
  if (shows_e) input.parameters.push_back({"e", "", old.e, now.e, se.e});
  if (const std::string other = results.other_robot(); !other.empty()) input.notes.push_back(other + '.');
  for (const std::string& square : results.left_out()) input.notes.push_back(square + '.');
  if (found == nullptr) return input;
  input.not_loaded = not_loaded != nullptr;
  input.reason = (input.not_loaded ? "The factors found were not loaded. " : "") + judgement_sentence(*found);
  input.method = method_text(*found);
  if (found->end_poses() == nullptr)
    std::ranges::move(gyro_notes(results, *found), std::back_inserter(input.notes));
  if (found->scans() != nullptr) input.scans = scan_figures(*found->scans(), drives_before(results), false);
  return input;
}

}  // namespace astro::experiment
