#include "host/report/scans.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/figures.hpp"
#include "host/report/html.hpp"

namespace astro::report {
namespace {

using nlohmann::json;

constexpr std::size_t kMostResiduals = 1500;

std::string map_figure(std::size_t number, const char* caption) {
  return fmt::format(
      R"(<figure data-figure="map" data-map="{0}"><figcaption class="phase-{0}">{1}</figcaption>
<div class="plot" role="img" aria-label="Walls as the scanner saw them, placed by odometry. {1}"></div></figure>)",
      number, caption);
}

json map_data(const std::vector<Point2>& points) {
  json x = json::array(), y = json::array();
  for (const Point2& point : points) {
    x.push_back(rounded(point.x_m, 1e3));
    y.push_back(rounded(point.y_m, 1e3));
  }
  return {{"x", x}, {"y", y}};
}

json residual_data(const std::vector<ScanFigures::Residual>& residuals, Pose2 ScanFigures::Residual::*of,
                   std::size_t step) {
  json x = json::array(), y = json::array(), h = json::array();
  for (std::size_t i = 0; i < residuals.size(); i += step) {
    const Pose2& residual = residuals[i].*of;
    x.push_back(rounded(1e3 * residual.x_m, 100));
    y.push_back(rounded(1e3 * residual.y_m, 100));
    h.push_back(rounded(1e3 * residual.theta_rad, 100));
  }
  return {{"x", x}, {"y", y}, {"h", h}};
}

}  // namespace

Section scan_section(const ReportInput& input) {
  Section out{"walls", "The walls, by odometry", ""};
  if (!input.scans) return out;
  out.body = fmt::format(
      R"(<p>What the laser scanner saw on {}, each scan where odometry says that the robot was. If odometry drifts, a wall that was passed twice appears twice.</p>
<div class="panels">{}{}</div>
<figure data-figure="residuals"><figcaption>Along all drives: the motion by scans less that by odometry, from one matched scan to the next</figcaption>
<div class="plot" role="img" aria-label="Differences of scans and odometry along, across and in heading, with both sets of factors"></div></figure>)",
      escape(input.scans->drive), map_figure(0, "Factors before"), map_figure(1, "Calibrated factors"));
  return out;
}

json scan_data(const ReportInput& input) {
  if (!input.scans) return nullptr;
  const ScanFigures& scans = *input.scans;
  using Residual = ScanFigures::Residual;
  const std::size_t step = scans.residuals.size() / (kMostResiduals + 1) + 1;
  json way = json::array();
  for (std::size_t i = 0; i < scans.residuals.size(); i += step)
    way.push_back(rounded(scans.residuals[i].way_m, 100));
  return {{"maps", {map_data(scans.before), map_data(scans.after)}},
          {"way", way},
          {"residuals",
           {residual_data(scans.residuals, &Residual::before, step),
            residual_data(scans.residuals, &Residual::after, step)}}};
}

}  // namespace astro::report
