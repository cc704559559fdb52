#include "host/calibration/end_pose.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "host/base/error.hpp"

namespace astro::calibration {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void require_values(std::span<const EndPose> runs, const std::string& set) {
  if (runs.empty()) {
    throw Error("there is no " + set + "run: record at least one, better five");
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string run = set + "run " + std::to_string(i + 1);
    if (!std::isfinite(runs[i].x_m) || !std::isfinite(runs[i].y_m) || std::isinf(runs[i].theta_rad)) {
      throw Error(run + " has an end pose that is not finite: measure it again or leave the run out");
    }
    if (std::isnan(runs[i].theta_rad) != std::isnan(runs[0].theta_rad)) {
      throw Error(run + (std::isnan(runs[i].theta_rad) ? " has no" : " has a") +
                  " heading error, unlike run 1: give the heading of every run or of none");
    }
  }
}

void set_standard_errors(ClusterSummary& out, std::span<const EndPose> runs) {
  EndPose squares;
  for (const EndPose& run : runs) {
    squares.x_m += std::pow(run.x_m - out.x_cg_m, 2);
    squares.y_m += std::pow(run.y_m - out.y_cg_m, 2);
    squares.theta_rad += std::pow(run.theta_rad - out.theta_cg_rad, 2);
  }
  const double n = static_cast<double>(runs.size());
  const double scale = n < 2 ? kNaN : 1 / (n * (n - 1));
  out.se_x_m = std::sqrt(squares.x_m * scale);
  out.se_y_m = std::sqrt(squares.y_m * scale);
  out.se_theta_rad = std::sqrt(squares.theta_rad * scale);
  out.se_r_m = std::hypot(out.se_x_m, out.se_y_m);
}

void set_means(ClusterSummary& out, std::span<const EndPose> runs) {
  EndPose sum, squares;
  for (const EndPose& run : runs) {
    sum.x_m += run.x_m;
    sum.y_m += run.y_m;
    sum.theta_rad += run.theta_rad;
    squares.x_m += run.x_m * run.x_m;
    squares.y_m += run.y_m * run.y_m;
    squares.theta_rad += run.theta_rad * run.theta_rad;
  }
  const double n = static_cast<double>(runs.size());
  out.x_cg_m = sum.x_m / n;
  out.y_cg_m = sum.y_m / n;
  out.theta_cg_rad = sum.theta_rad / n;
  out.r_cg_m = std::hypot(out.x_cg_m, out.y_cg_m);
  out.rms_x_m = std::sqrt(squares.x_m / n);
  out.rms_y_m = std::sqrt(squares.y_m / n);
  out.rms_r_m = std::hypot(out.rms_x_m, out.rms_y_m);
  out.rms_theta_rad = std::sqrt(squares.theta_rad / n);
}

ClusterSummary summarize_set(std::span<const EndPose> runs, const std::string& set) {
  require_values(runs, set);
  ClusterSummary out;
  out.runs = static_cast<int>(runs.size());
  out.has_theta = !std::isnan(runs[0].theta_rad);
  set_means(out, runs);
  set_standard_errors(out, runs);
  return out;
}

}  // namespace

ClusterSummary summarize(std::span<const EndPose> runs) { return summarize_set(runs, ""); }

ExperimentSummary summarize(std::span<const EndPose> cw, std::span<const EndPose> ccw) {
  ExperimentSummary out;
  out.cw = summarize_set(cw, "clockwise ");
  out.ccw = summarize_set(ccw, "counter-clockwise ");
  const ClusterSummary& worse = out.cw.r_cg_m > out.ccw.r_cg_m ? out.cw : out.ccw;
  out.E_max_syst_m = worse.r_cg_m;
  out.se_E_max_syst_m = worse.se_r_m;
  return out;
}

}  // namespace astro::calibration
