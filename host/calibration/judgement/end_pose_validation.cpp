#include "host/calibration/judgement/end_pose_validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/judgement/remarks.hpp"

namespace astro::calibration {
namespace {

/// Sum of the squared distances of the ends from the mean of their direction, and its degrees of freedom. Ends without a
/// heading count with their positions.
struct Scatter {
  double position_m2 = 0, position_dof = 0, heading_rad2 = 0, heading_dof = 0;

  void add(std::span<const EndPose> ends) {
    const ClusterSummary mean = summarize(ends);
    double headings = 0;
    for (const EndPose& end : ends) {
      position_m2 += std::pow(end.x_m - mean.x_cg_m, 2) + std::pow(end.y_m - mean.y_cg_m, 2);
      if (std::isnan(end.theta_rad)) continue;
      heading_rad2 += std::pow(end.theta_rad - mean.theta_cg_rad, 2);
      ++headings;
    }
    position_dof += 2 * (static_cast<double>(ends.size()) - 1);
    heading_dof += std::max(0.0, headings - 1);
  }
};

/// The rest of an end error with factors that predict `expected` of it.
RunErrors left_of(const EndPose& end, const EndPose& expected, std::string name) {
  return {std::move(name), std::hypot(end.x_m - expected.x_m, end.y_m - expected.y_m),
          end.theta_rad - expected.theta_rad, std::numeric_limits<double>::quiet_NaN()};
}

/// -2 log likelihood of an end, without terms that do not depend on the factors. No end counts as measured better than to a
/// tenth of a millimetre and of a milliradian, even if the ends of a simulation scatter less.
double cost_of(const RunErrors& left, const Scatter& scatter) {
  constexpr double kLeastVariance = 1e-8;
  const double position =
      left.final_m * left.final_m / std::max(scatter.position_m2 / scatter.position_dof, kLeastVariance);
  if (!std::isfinite(left.final_heading_rad) || scatter.heading_dof == 0) return position;
  return position + left.final_heading_rad * left.final_heading_rad /
                        std::max(scatter.heading_rad2 / scatter.heading_dof, kLeastVariance);
}

std::vector<EndPose> without(std::span<const EndPose> ends, std::size_t index) {
  std::vector<EndPose> rest(ends.begin(), ends.end());
  if (rest.size() > 1) rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(index % rest.size()));
  return rest;
}

}  // namespace

CrossValidation cross_validate(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                               const WheelFactors& in_use, const Options& options) {
  CrossValidation out;
  if (cw.size() < 2 || ccw.size() < 2) {
    out.not_judged.push_back(
        {"there are not two squares in each direction", JudgementProblem::too_few_squares});
    return out;
  }
  Scatter scatter;
  scatter.add(cw);
  scatter.add(ccw);
  const auto judge_end = [&](std::span<const EndPose> ends, std::size_t index, Sense sense,
                             const WheelFactors& found) {
    if (index >= ends.size()) return;  // of the direction with fewer squares
    const std::string name = (sense == Sense::cw ? "cw " : "ccw ") + std::to_string(index + 1);
    const EndPose expected = replay_square(side_m, sense, in_use, found);
    HeldOutRun run{left_of(ends[index], {}, name), left_of(ends[index], expected, name), found};
    run.gain = cost_of(run.in_use, scatter) - cost_of(run.found, scatter);
    out.runs.push_back(run);
  };
  for (std::size_t i = 0; i < std::max(cw.size(), ccw.size()); ++i) {
    try {
      const WheelFactors found =
          estimate_factors(without(cw, i), without(ccw, i), side_m, in_use, options).factors;
      judge_end(cw, i, Sense::cw, found);
      judge_end(ccw, i, Sense::ccw, found);
    } catch (const Error& error) {
      out.not_judged.push_back(CrossValidation::without({"squares " + std::to_string(i + 1)}, error));
    }
  }
  out.judge();
  return out;
}

void cross_validate_scale(std::span<const LineEnd> lines, const WheelFactors& in_use, const LineScale& scale,
                          CrossValidation& judged) {
  if (lines.size() < 2) {
    judged.not_judged.push_back({"the scale comes from a single line: drive lines or squares as well",
                                 JudgementProblem::single_line});
    return;
  }
  const double loaded = (in_use.c_r + in_use.c_l) / 2;
  // The error of the mean, which contains slip, reading and scatter, says how far a single line may be off.
  const double variance = static_cast<double>(lines.size()) * scale.se * scale.se;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::vector<LineEnd> others(lines.begin(), lines.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const double found = scale_of_lines(others)->scale, is = lines[i].scale();
    const auto missed = [&](double expected) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      return RunErrors{"line " + std::to_string(i + 1),
                       std::abs(is - expected) / lines[i].loaded_scale * lines[i].driven_m, none, none};
    };
    HeldOutRun run{missed(loaded), missed(found), in_use};
    const double change = found / loaded;
    run.without_it = {change * in_use.c_r, change * in_use.c_l, change * in_use.b_m};
    run.gain = (std::pow(is - loaded, 2) - std::pow(is - found, 2)) / variance;
    judged.runs.push_back(run);
  }
  judged.judge();
}

}  // namespace astro::calibration
