#include "host/experiment/analysis/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/error.hpp"
#include "host/experiment/analysis/analysis_problem.hpp"
#include "host/experiment/analysis/json.hpp"
#include "host/experiment/analysis/judgement_sentences.hpp"
#include "host/experiment/files/experiment_folder.hpp"
#include "host/experiment/files/factors_json.hpp"
#include "host/experiment/files/robot_identity.hpp"
#include "host/recording/run_folder.hpp"
#include "host/report/comparison.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

RunSet read_phase(const fs::path& folder, const Plan& plan, std::size_t phase, recording::Damage damage) {
  const std::vector<RunSpec> specs = runs_of_phase(plan, phase, squares_in_phase(folder, plan, phase));
  for (const RunSpec& spec : specs)
    if (!fs::exists(file_of(folder, spec))) return {};
  return read_specs(folder, specs, damage);
}

PhaseResult phase_of(const std::string& name, std::shared_ptr<const Recordings> recordings) {
  PhaseResult phase;
  phase.name = name;
  phase.recordings = std::move(recordings);
  phase.summary = calibration::summarize(phase.squares().cw, phase.squares().ccw);
  return phase;
}

std::string millimetres(double metres, double error) {
  if (!std::isfinite(error)) return fmt::format("{:.1f}", 1000 * metres);
  return fmt::format("{:.1f} ± {:.1f}", 1000 * metres, 1000 * error);
}

/// By how much the measured lines of a phase are longer than odometry said, in percent; "" without lines.
std::string lines_beyond_odometry(const PhaseResult& phase) {
  const auto scale = calibration::scale_of_lines(phase.squares().lines);
  if (!scale) return "";
  const double loaded = phase.squares().lines.front().loaded_scale;
  return fmt::format("{:+.2f} ± {:.2f}", 100 * (scale->scale / loaded - 1), 100 * scale->se / loaded);
}

std::vector<std::string> row(const Results& results, const std::string& name, const std::string& unit,
                             const auto& value) {
  std::vector<std::string> cells{name, unit};
  for (const PhaseResult& phase : results.phases) cells.push_back(value(phase));
  return cells;
}

}  // namespace

const Calibration* Results::last_calibration() const {
  if (phases.size() < 2) return nullptr;
  const std::optional<Calibration>& last = phases[phases.size() - 2].calibration;
  return last ? &*last : nullptr;
}

const Calibration* Results::not_loaded() const {
  const std::optional<Calibration>& found = after().calibration;
  if (!found) return nullptr;
  return journal.loaded.contains(phase_names(journal.plan)[phases.size()]) ? nullptr : &*found;
}

calibration::Improvement Results::gain() const {
  return calibration::improvement(calibration::E_max_syst_mm(before().summary),
                                  calibration::E_max_syst_mm(after().summary));
}

bool Results::shows_e() const {
  return std::ranges::any_of(phases, [](const PhaseResult& phase) { return phase.squares().loaded.e != 0; });
}

std::vector<std::string> Results::left_out() const {
  std::vector<std::string> all;
  for (const PhaseResult& phase : phases)
    all.insert(all.end(), phase.squares().left_out.begin(), phase.squares().left_out.end());
  return all;
}

std::string Results::other_robot() const {
  for (const PhaseResult& phase : phases)
    for (const recording::Run& run : phase.runs())
      if (const std::string sentence =
              different_robots("'" + before().name + "'", identity_of(before().runs().front().info),
                               "'" + phase.name + "'", identity_of(run.info));
          !sentence.empty())
        return sentence + ": what is compared may be the robots";
  return {};
}

std::string Results::verdict() const {
  const std::string was = lines_beyond_odometry(before()), is = lines_beyond_odometry(after());
  const std::string lines =
      was.empty() || is.empty() || phases.size() < 2
          ? ""
          : fmt::format(" Measured lines differ from what odometry said by {} % before and {} % after.", was,
                        is);
  return fmt::format("E_max_syst is {}: improvement factor {}. {}{}", report::claim(gain()),
                     report::describe(gain()),
                     report::verdict_sentence(calibration::E_max_syst_mm(before().summary),
                                              calibration::E_max_syst_mm(after().summary)),
                     lines);
}

Results read_results(const fs::path& folder, recording::Damage damage) {
  Results results;
  results.journal = read_journal(folder);
  const Plan& plan = results.journal.plan;
  const std::vector<std::string> names = phase_names(plan);
  std::vector<std::shared_ptr<const Recordings>> driven;
  for (std::size_t i = 0; i < names.size(); ++i) {
    RunSet set = read_phase(folder, plan, i, damage);
    if (set.runs.empty()) break;
    driven.push_back(std::make_shared<const Recordings>(std::move(set)));
    results.phases.push_back(phase_of(names[i], driven.back()));
    if (i + 1 < names.size()) results.phases.back().calibration = calibrate_after(driven, plan.method);
  }
  if (results.phases.empty())
    throw Error("the experiment in '" + folder.string() + "' has not driven its first phase to the end",
                AnalysisProblem::no_phase_complete, {folder.string()});
  return results;
}

Results results_of(Journal journal, std::span<const std::shared_ptr<const Recordings>> phases,
                   std::span<const Calibration> calibrations) {
  Results results;
  results.journal = std::move(journal);
  const std::vector<std::string> names = phase_names(results.journal.plan);
  for (std::size_t i = 0; i < phases.size(); ++i) {
    results.phases.push_back(phase_of(names[i], phases[i]));
    if (i < calibrations.size()) results.phases.back().calibration = calibrations[i];
  }
  return results;
}

Results read_folders(const std::vector<fs::path>& folders, recording::Damage damage) {
  Results results;
  for (const fs::path& folder : folders) {
    RunSet set;
    set.runs = recording::read_runs(folder, damage);
    set.names.resize(set.runs.size());
    const std::string name = fs::absolute(folder).lexically_normal().filename().string();
    results.phases.push_back(phase_of(name, std::make_shared<const Recordings>(std::move(set))));
  }
  const recording::RunInfo& info = results.before().runs().front().info;
  Journal& journal = results.journal;
  journal.robot_id = info.robot_id;
  journal.robot_name = info.robot_name;
  journal.board = info.board;
  journal.firmware = info.firmware;
  journal.started_at = info.started_at;
  journal.plan.truth = info.truth_source;
  journal.plan.side_m = results.before().squares().side_m;
  journal.plan.speed_mps = info.speed_mps;
  journal.plan.runs = results.before().summary.cw.runs;
  return results;
}

nlohmann::json to_json(const Results& results) {
  nlohmann::json json;
  json["before"] = to_json(results.before().summary);
  json["after"] = results.phases.size() > 1 ? to_json(results.after().summary) : nlohmann::json();
  json["improvement"] = results.phases.size() > 1 ? number(results.improvement()) : nlohmann::json();
  json["improvement_95"] = nullptr;
  if (results.phases.size() > 1)
    json["improvement_95"] = {number(results.gain().low), number(results.gain().high)};
  json["phases"] = nlohmann::json::array();
  for (const PhaseResult& phase : results.phases) {
    // "carried": the loaded factors, as in json.cpp.
    nlohmann::json entry = {{"name", phase.name}, {"carried", to_json(phase.squares().loaded)}};
    entry["squares"] = to_json(phase.summary);
    entry["estimate"] = phase.calibration ? to_json(*phase.calibration) : nlohmann::json();
    json["phases"].push_back(entry);
  }
  json["parameters"] = {{"old", to_json(results.before().squares().loaded)}, {"new", nullptr}};
  if (const Calibration* last = results.last_calibration()) {
    json["parameters"]["new"] = to_json(results.after().squares().loaded);
    json["parameters"]["standard_errors"] = {{"c_R", number(last->se.c_r)},
                                             {"c_L", number(last->se.c_l)},
                                             {"b_m", number(last->se.b_m)},
                                             {"e", number(last->se.e)}};
  }
  const Calibration* const not_loaded = results.not_loaded();
  json["not_loaded"] = nullptr;  // or why, in a sentence
  if (not_loaded != nullptr) json["not_loaded"] = judgement_sentence(*not_loaded);
  json["robot"] = {{"id", results.journal.robot_id}, {"name", results.journal.robot_name}};
  return json;
}

std::vector<std::vector<std::string>> before_after_table(const Results& results) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back(row(results, "", "", [](const PhaseResult& phase) { return phase.name; }));
  rows.push_back(row(results, "E_max_syst", "mm", [](const PhaseResult& phase) {
    return millimetres(phase.summary.E_max_syst_m, phase.summary.se_E_max_syst_m);
  }));
  const auto cluster = [&](const std::string& name, auto member) {
    rows.push_back(row(results, name + " r_cg", "mm", [&](const PhaseResult& phase) {
      return millimetres((phase.summary.*member).r_cg_m, (phase.summary.*member).se_r_m);
    }));
    rows.push_back(row(results, name + " RMS r", "mm", [&](const PhaseResult& phase) {
      return fmt::format("{:.1f}", 1000 * (phase.summary.*member).rms_r_m);
    }));
    rows.push_back(row(results, name + " RMS heading", "mrad", [&](const PhaseResult& phase) {
      const double rms = (phase.summary.*member).rms_theta_rad;
      return std::isfinite(rms) ? fmt::format("{:.1f}", 1000 * rms) : std::string("-");
    }));
  };
  cluster("cw", &calibration::ExperimentSummary::cw);
  cluster("ccw", &calibration::ExperimentSummary::ccw);
  if (!lines_beyond_odometry(results.before()).empty())
    rows.push_back(row(results, "lines beyond odometry", "%", lines_beyond_odometry));
  rows.push_back(row(results, "c_R", "", [](const PhaseResult& phase) {
    return fmt::format("{:.7f}", phase.squares().loaded.c_r);
  }));
  rows.push_back(row(results, "c_L", "", [](const PhaseResult& phase) {
    return fmt::format("{:.7f}", phase.squares().loaded.c_l);
  }));
  rows.push_back(row(results, "b", "mm", [](const PhaseResult& phase) {
    return fmt::format("{:.4f}", 1000 * phase.squares().loaded.b_m);
  }));
  if (results.shows_e())
    rows.push_back(row(results, "e", "", [](const PhaseResult& phase) {
      return fmt::format("{:.6f}", phase.squares().loaded.e);
    }));
  return rows;
}

}  // namespace astro::experiment
