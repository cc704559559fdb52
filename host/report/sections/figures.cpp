#include "host/report/sections/figures.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/sections/series.hpp"
#include "host/report/sections/squares.hpp"

namespace astro::report {

namespace {

using nlohmann::json;

constexpr std::size_t kPointsPerRun = 1500;

json rounded(double value, double per_unit) {
  if (!std::isfinite(value)) return nullptr;
  return std::round(value * per_unit) / per_unit;
}

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

}  // namespace

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
