#include "host/report/figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <tuple>

#include "host/base/text/sense.hpp"
#include "host/recording/aligned_paths.hpp"
#include "host/report/html.hpp"
#include "host/report/squares.hpp"

namespace astro::report {

namespace {

using nlohmann::json;
using recording::RunInfo;

struct GroupKey {
  int kind_rank;
  std::string kind;
  int direction_rank;
  long size_mm;
  bool operator<(const GroupKey& o) const {
    return std::tie(kind_rank, kind, direction_rank, size_mm) <
           std::tie(o.kind_rank, o.kind, o.direction_rank, o.size_mm);
  }
};

GroupKey group_key_of(const RunInfo& info) {
  constexpr std::array known{"square", "circle", "line"};
  const auto found = std::find(known.begin(), known.end(), info.kind);
  const int direction = info.direction == Sense::cw ? 0 : info.direction == Sense::ccw ? 1 : 2;
  return {static_cast<int>(found - known.begin()), info.kind, direction,
          static_cast<long>(info.size_m * 1000 + 0.5)};
}

/// "clockwise", "counter-clockwise", "".
std::string direction_name(std::optional<Sense> direction) { return direction ? in_words(*direction) : ""; }

std::string group_title(const RunInfo& info) {
  std::string title;
  if (info.kind == "square")
    title = fmt::format("Squares of {:g} m", info.size_m);
  else if (info.kind == "circle")
    title = fmt::format("Circles of {:g} m radius", info.size_m);
  else if (info.kind == "line")
    title = fmt::format("Straight lines of {:g} m", info.size_m);
  else
    title = info.kind.empty() ? "Other runs" : capitalised(info.kind);
  const std::string direction = direction_name(info.direction);
  return direction.empty() ? title : title + ", " + direction;
}

constexpr std::size_t kPointsPerRun = 1500;

json cluster(std::size_t phase, const char* direction, const std::vector<calibration::EndPose>& ends,
             const calibration::ClusterSummary& summary) {
  json x = json::array(), y = json::array();
  for (const auto& end : ends) {
    x.push_back(rounded(end.x_m * 1e3, 100));
    y.push_back(rounded(end.y_m * 1e3, 100));
  }
  const auto mm = [](double metres) { return rounded(metres * 1e3, 1000); };
  return {{"phase", phase},
          {"direction", direction},
          {"x", x},
          {"y", y},
          {"mean", {mm(summary.x_cg_m), mm(summary.y_cg_m)}},
          {"se", {mm(summary.se_x_m), mm(summary.se_y_m)}},
          {"r", mm(summary.r_cg_m)},
          {"se_r", mm(summary.se_r_m)}};
}

json run_data(const recording::Run& run, std::size_t position) {
  json t = json::array(), x = json::array(), y = json::array();
  json ex = json::array(), ey = json::array(), eh = json::array();
  bool tracked = false;
  for (const auto& p : thin(series_of(run), kPointsPerRun)) {
    t.push_back(rounded(p.time_s, 1e3));
    x.push_back(rounded(p.odometry.x_m, 1e4));
    y.push_back(rounded(p.odometry.y_m, 1e4));
    ex.push_back(rounded(p.error.x_m * 1e3, 100));
    ey.push_back(rounded(p.error.y_m * 1e3, 100));
    eh.push_back(rounded(p.error.theta_rad, 1e5));
    tracked |= std::isfinite(p.error.x_m);
  }
  const auto number = run.info.index > 0 ? static_cast<std::size_t>(run.info.index) : position + 1;
  return {{"number", number}, {"tracked", tracked}, {"t", t},   {"x", x},
          {"y", y},           {"ex", ex},           {"ey", ey}, {"eh", eh}};
}

/// The number of a run: its index in the recording if there is one, otherwise its position.
std::string run_number(const RunGroup& group, std::size_t position) {
  for (const auto& runs : group.phases) {
    if (position < runs.size() && runs[position]->info.index > 0)
      return std::to_string(runs[position]->info.index);
  }
  return std::to_string(position + 1);
}

std::string selector(const RunGroup& group, std::size_t number) {
  if (group.most_runs() < 2) return "";
  std::string out = R"(<fieldset class="selector" data-runs><legend>Run</legend>)";
  for (std::size_t i = 0; i < group.most_runs(); ++i) {
    out += fmt::format(
        R"(<label><input type="radio" name="runs-{}" value="{}" autocomplete="off"{}><span>{}</span></label>)",
        number, i, i == 0 ? " checked" : "", run_number(group, i));
  }
  return out +
         fmt::format(
             R"(<label><input type="radio" name="runs-{}" value="all" autocomplete="off"><span>all</span></label></fieldset>)",
             number);
}

std::string path_figure(const ReportInput& input, const RunGroup& group, std::size_t number,
                        std::size_t phase) {
  const std::string title = capitalised(input.phases[phase].title);
  return fmt::format(
      R"(<figure data-figure="path" data-group="{}" data-phase="{}"><figcaption class="phase-{}">{}, <span class="chosen">run {}</span></figcaption>
<div class="plot" role="img" aria-label="{}, {}: true path and path by odometry"></div></figure>)",
      number, phase, phase % kAccents, escape(title), run_number(group, 0), escape(group.title),
      escape(title));
}

std::string error_figure(const RunGroup& group, std::size_t number) {
  const auto tracked = [](const auto& runs) {
    return std::any_of(runs.begin(), runs.end(), [](auto* run) { return !run->truth.empty(); });
  };
  if (std::none_of(group.phases.begin(), group.phases.end(), tracked)) {
    return R"(<p class="quiet">No ground truth was recorded along these runs, so there are no errors over time.</p>)";
  }
  return fmt::format(
      R"(<figure data-figure="errors" data-group="{}"><figcaption>Errors along the way (ground truth minus odometry), <span class="chosen">run {}</span></figcaption>
<div class="plot" role="img" aria-label="{}: x, y and heading error over time, every phase"></div></figure>)",
      number, run_number(group, 0), escape(group.title));
}

std::string group_section(const ReportInput& input, const RunGroup& group, std::size_t number) {
  std::string paths;
  for (std::size_t phase = 0; phase < group.phases.size(); ++phase) {
    if (!group.phases[phase].empty()) paths += path_figure(input, group, number, phase);
  }
  const char* const stretched =
      group.kind == "line"
          ? R"(<p class="quiet">Sideways motion is drawn in millimetres, far larger than the way ahead.</p>)"
          : "";
  return fmt::format(
      R"(<section class="group" data-group="{}"><h3>{}</h3>{}{}<div class="panels">{}</div>{}</section>)",
      number, escape(group.title), selector(group, number), stretched, paths, error_figure(group, number));
}

}  // namespace

json rounded(double value, double per_unit) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * per_unit) / per_unit;
}

std::size_t RunGroup::most_runs() const {
  std::size_t most = 0;
  for (const auto& runs : phases) most = std::max(most, runs.size());
  return most;
}

std::vector<RunGroup> group_runs(const std::vector<Phase>& phases) {
  std::map<GroupKey, RunGroup> groups;
  for (std::size_t phase = 0; phase < phases.size(); ++phase) {
    for (const auto& run : phases[phase].runs) {
      if (run.odometry.empty()) continue;
      auto& group = groups[group_key_of(run.info)];
      group.title = group_title(run.info);
      group.kind = run.info.kind;
      group.phases.resize(phases.size());
      group.phases[phase].push_back(&run);
    }
  }
  std::vector<RunGroup> out;
  for (auto& [key, group] : groups) {
    for (auto& runs : group.phases) {
      std::stable_sort(runs.begin(), runs.end(),
                       [](auto* a, auto* b) { return a->info.index < b->info.index; });
    }
    out.push_back(std::move(group));
  }
  return out;
}

std::vector<SeriesPoint> series_of(const recording::Run& run) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto paths = recording::align_paths(run);
  std::vector<SeriesPoint> points;
  points.reserve(paths.odometry.size());
  auto error = paths.error.begin();
  for (const auto& sample : paths.odometry) {
    points.push_back({sample.time_s, sample.pose, {kNone, kNone, kNone}});
    // The errors are a subset of the odometry's times, in the same order and with the same bits.
    if (error != paths.error.end() && error->time_s == sample.time_s) points.back().error = (error++)->pose;
  }
  return points;
}

std::vector<SeriesPoint> thin(std::vector<SeriesPoint> points, std::size_t most) {
  if (points.size() <= most) return points;
  std::vector<SeriesPoint> kept;
  kept.reserve(most);
  for (std::size_t i = 0; i < most; ++i) kept.push_back(points[i * (points.size() - 1) / (most - 1)]);
  return kept;
}

Section run_figures(const ReportInput& input, const std::vector<RunGroup>& groups) {
  Section out{"runs", "Runs: odometry against ground truth", ""};
  for (std::size_t i = 0; i < groups.size(); ++i) out.body += group_section(input, groups[i], i);
  return out;
}

json figure_data(const std::vector<Phase>& phases, const std::vector<RunGroup>& groups) {
  json out = {{"phases", json::array()}, {"clusters", json::array()}, {"groups", json::array()}};
  for (std::size_t i = 0; i < phases.size(); ++i) {
    out["phases"].push_back(phases[i].title);
    if (!has_squares(phases[i])) continue;
    out["clusters"].push_back(cluster(i, "cw", phases[i].cw, phases[i].squares.cw));
    out["clusters"].push_back(cluster(i, "ccw", phases[i].ccw, phases[i].squares.ccw));
  }
  for (const auto& group : groups) {
    json columns = json::array();
    for (const auto& runs : group.phases) {
      json column = json::array();
      for (std::size_t i = 0; i < runs.size(); ++i) column.push_back(run_data(*runs[i], i));
      columns.push_back(std::move(column));
    }
    out["groups"].push_back({{"kind", group.kind}, {"phases", std::move(columns)}});
  }
  return out;
}

}  // namespace astro::report
