#include "host/calibration/end_poses/end_pose.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/base/text/sense.hpp"
#include "host/calibration/end_poses/end_pose_problem.hpp"

namespace astro::calibration {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// `direction`: "clockwise", or nothing.
void require_values(std::span<const EndPose> runs, const std::string& direction) {
  const std::string set = direction.empty() ? "" : direction + ' ';
  if (runs.empty()) {
    throw Error("there is no " + set + "run: record at least one, better five", EndPoseProblem::no_run,
                direction.empty() ? std::vector<std::string>{} : std::vector{direction});
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string run = set + "run " + std::to_string(i + 1);
    if (!std::isfinite(runs[i].x_m) || !std::isfinite(runs[i].y_m) || std::isinf(runs[i].theta_rad)) {
      throw Error(run + " has an end pose that is not finite: measure it again or leave the run out",
                  EndPoseProblem::not_finite, {run});
    }
  }
}

struct MeanAndSquares {
  double mean = 0, rms = 0, se = 0;
  int count = 0;
};

/// Statistics of one coordinate over the runs in which it was measured; NaN if there is none.
MeanAndSquares moments_of(std::span<const EndPose> runs, double EndPose::*value) {
  std::vector<double> measured;
  for (const EndPose& run : runs)
    if (!std::isnan(run.*value)) measured.push_back(run.*value);
  const auto squares_about = [&measured](double center) {
    double sum = 0;
    for (const double one : measured) sum += (one - center) * (one - center);
    return sum;
  };
  const auto n = static_cast<double>(measured.size());
  MeanAndSquares out;
  out.count = static_cast<int>(measured.size());
  out.mean = n > 0 ? std::accumulate(measured.begin(), measured.end(), 0.0) / n : kNaN;
  out.rms = n > 0 ? std::sqrt(squares_about(0) / n) : kNaN;
  out.se = n < 2 ? kNaN : std::sqrt(squares_about(out.mean) / (n * (n - 1)));
  return out;
}

ClusterSummary summarize_set(std::span<const EndPose> runs, const std::string& direction) {
  require_values(runs, direction);
  ClusterSummary out;
  out.runs = static_cast<int>(runs.size());
  const MeanAndSquares x = moments_of(runs, &EndPose::x_m), y = moments_of(runs, &EndPose::y_m),
                       theta = moments_of(runs, &EndPose::theta_rad);
  out.has_theta = theta.count > 0;
  out.x_cg_m = x.mean;
  out.y_cg_m = y.mean;
  out.theta_cg_rad = theta.mean;
  out.r_cg_m = std::hypot(out.x_cg_m, out.y_cg_m);
  out.rms_x_m = x.rms;
  out.rms_y_m = y.rms;
  out.rms_r_m = std::hypot(out.rms_x_m, out.rms_y_m);
  out.rms_theta_rad = theta.rms;
  out.se_x_m = x.se;
  out.se_y_m = y.se;
  out.se_theta_rad = theta.se;
  out.se_r_m = std::hypot(out.se_x_m, out.se_y_m);
  return out;
}

}  // namespace

ClusterSummary summarize(std::span<const EndPose> runs) { return summarize_set(runs, ""); }

ExperimentSummary summarize(std::span<const EndPose> cw, std::span<const EndPose> ccw) {
  ExperimentSummary out;
  out.cw = summarize_set(cw, in_words(Sense::cw));
  out.ccw = summarize_set(ccw, in_words(Sense::ccw));
  const ClusterSummary& worse = out.cw.r_cg_m > out.ccw.r_cg_m ? out.cw : out.ccw;
  out.E_max_syst_m = worse.r_cg_m;
  out.se_E_max_syst_m = worse.se_r_m;
  return out;
}

}  // namespace astro::calibration
