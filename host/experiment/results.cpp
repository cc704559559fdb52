#include "host/experiment/results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/base/error.hpp"
#include "host/experiment/json.hpp"
#include "host/recording/run_file.hpp"
#include "host/recording/run_folder.hpp"

namespace astro::experiment {
namespace {

namespace fs = std::filesystem;

std::vector<recording::Run> read_phase(const fs::path& folder, const Plan& plan, std::size_t phase) {
  std::vector<recording::Run> runs;
  for (const RunSpec& spec : runs_of_phase(plan, phase)) {
    const fs::path path = folder / spec.phase / spec.file_name();
    if (!fs::exists(path)) return {};
    runs.push_back(recording::read_run(path));
  }
  return runs;
}

nlohmann::json factors_json(const calibration::WheelFactors& factors) {
  return {{"c_R", factors.c_r}, {"c_L", factors.c_l}, {"b_m", factors.b_m}};
}

std::string millimetres(double metres, double error) {
  if (!std::isfinite(error)) return fmt::format("{:.1f}", 1000 * metres);
  return fmt::format("{:.1f} ± {:.1f}", 1000 * metres, 1000 * error);
}

std::vector<std::string> row(const Results& results, const std::string& name, const std::string& unit,
                             const auto& value) {
  std::vector<std::string> cells{name, unit};
  for (const PhaseResult& phase : results.phases) cells.push_back(value(phase));
  return cells;
}

}  // namespace

const calibration::Estimate* Results::last_estimate() const {
  if (phases.size() < 2) return nullptr;
  return phases[phases.size() - 2].estimate ? &*phases[phases.size() - 2].estimate : nullptr;
}

double Results::improvement() const { return before().summary.E_max_syst_m / after().summary.E_max_syst_m; }

Results read_results(const fs::path& folder) {
  Results results;
  results.journal = read_journal(folder);
  const Plan& plan = results.journal.plan;
  const std::vector<std::string> names = phase_names(plan);
  for (std::size_t i = 0; i < names.size(); ++i) {
    PhaseResult phase;
    phase.name = names[i];
    phase.runs = read_phase(folder, plan, i);
    if (phase.runs.empty()) break;
    phase.squares = squares_of(phase.runs);
    phase.summary = calibration::summarize(phase.squares.cw, phase.squares.ccw);
    if (i + 1 < names.size()) phase.estimate = estimate(phase.squares, plan.method);
    results.phases.push_back(std::move(phase));
  }
  if (results.phases.empty())
    throw Error("the experiment in '" + folder.string() +
                "' has not driven its first phase to the end: run 'astrolabe "
                "umbmark --out " +
                folder.string() + "' again to go on with it");
  return results;
}

Results read_folders(const std::vector<fs::path>& folders) {
  Results results;
  for (const fs::path& folder : folders) {
    PhaseResult phase;
    phase.name = fs::absolute(folder).lexically_normal().filename().string();
    phase.runs = recording::read_runs(folder);
    phase.squares = squares_of(phase.runs);
    phase.summary = calibration::summarize(phase.squares.cw, phase.squares.ccw);
    results.phases.push_back(std::move(phase));
  }
  const recording::RunInfo& info = results.before().runs.front().info;
  Journal& journal = results.journal;
  journal.robot_id = info.robot_id;
  journal.robot_name = info.robot_name;
  journal.board = info.board;
  journal.firmware = info.firmware;
  journal.started_at = info.started_at;
  journal.plan.truth = info.truth_source;
  journal.plan.side_m = results.before().squares.side_m;
  journal.plan.speed_mps = info.speed_mps;
  journal.plan.runs = results.before().summary.cw.runs;
  return results;
}

nlohmann::json to_json(const Results& results) {
  nlohmann::json json;
  json["before"] = to_json(results.before().summary);
  json["after"] = results.phases.size() > 1 ? to_json(results.after().summary) : nlohmann::json();
  json["improvement"] = results.phases.size() > 1 ? number(results.improvement()) : nlohmann::json();
  json["phases"] = nlohmann::json::array();
  for (const PhaseResult& phase : results.phases) {
    nlohmann::json entry = {{"name", phase.name}, {"carried", factors_json(phase.squares.carried)}};
    entry["squares"] = to_json(phase.summary);
    entry["estimate"] = phase.estimate ? to_json(*phase.estimate) : nlohmann::json();
    json["phases"].push_back(entry);
  }
  json["parameters"] = {{"old", factors_json(results.before().squares.carried)}, {"new", nullptr}};
  if (const calibration::Estimate* estimate = results.last_estimate()) {
    json["parameters"]["new"] = factors_json(results.after().squares.carried);
    json["parameters"]["standard_errors"] = {{"c_R", number(estimate->se.c_r)},
                                             {"c_L", number(estimate->se.c_l)},
                                             {"b_m", number(estimate->se.b_m)}};
  }
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
  rows.push_back(row(results, "c_R", "", [](const PhaseResult& phase) {
    return fmt::format("{:.7f}", phase.squares.carried.c_r);
  }));
  rows.push_back(row(results, "c_L", "", [](const PhaseResult& phase) {
    return fmt::format("{:.7f}", phase.squares.carried.c_l);
  }));
  rows.push_back(row(results, "b", "mm", [](const PhaseResult& phase) {
    return fmt::format("{:.4f}", 1000 * phase.squares.carried.b_m);
  }));
  return rows;
}

report::ReportInput report_input(const Results& results) {
  const Journal& journal = results.journal;
  report::ReportInput input;
  input.title = "Odometry calibration of " + journal.robot_name;
  input.description = {
      {"Robot", journal.robot_name},
      {"Unique id", journal.robot_id},
      {"Board", journal.board},
      {"Firmware", journal.firmware},
      {"Started", journal.started_at},
      {"Ground truth", journal.plan.truth},
      {"Squares", fmt::format("{} clockwise and {} counter-clockwise, side {} m", journal.plan.runs,
                              journal.plan.runs, journal.plan.side_m)},
      {"Speed", fmt::format("{} m/s, {} rad/s", journal.plan.speed_mps, journal.plan.yaw_rate_radps)}};
  for (const PhaseResult& phase : results.phases)
    input.phases.push_back({phase.name, phase.runs, phase.summary, phase.squares.cw, phase.squares.ccw});
  const calibration::WheelFactors& old = results.before().squares.carried;
  const calibration::WheelFactors& now = results.after().squares.carried;
  const calibration::Estimate* last = results.last_estimate();
  const double unknown = std::nan("");
  input.parameters = {{"c_R", "", old.c_r, now.c_r, last != nullptr ? last->se.c_r : unknown},
                      {"c_L", "", old.c_l, now.c_l, last != nullptr ? last->se.c_l : unknown},
                      {"b", "m", old.b_m, now.b_m, last != nullptr ? last->se.b_m : unknown}};
  if (last != nullptr) {
    input.method = fmt::format("Method: {}.", calibration::name_of(last->options.method));
    if (last->options.method == calibration::Method::umbmark)
      input.method += fmt::format(" Angles from: {}.", calibration::name_of(last->options.angles));
    if (last->options.method == calibration::Method::extended)
      input.method += fmt::format(" Formula: {}.", calibration::name_of(last->options.formula));
    input.method +=
        "\n\nThe estimate is composed with the factors that the robot carried while it drove. A closed "
        "square is blind "
        "to the common scale of both wheels, so c_R + c_L is left as it was.";
  }
  return input;
}

}  // namespace astro::experiment
