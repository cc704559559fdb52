#include "host/calibration/judgement/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/calibration/end_poses/replay.hpp"
#include "host/calibration/judgement/student_t.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {
namespace {

constexpr std::size_t kMostGroups = 10;
constexpr int kPriorRuns = 4;

/// Every so many-th run, so that a group has runs of all kinds and senses if they were driven by turns or one after
/// the other.
std::vector<std::size_t> members_of(std::size_t index, std::size_t groups, std::size_t runs) {
  std::vector<std::size_t> members;
  for (std::size_t i = index; i < runs; i += groups) members.push_back(i);
  return members;
}

bool contains(std::span<const std::size_t> members, std::size_t run) {
  return std::find(members.begin(), members.end(), run) != members.end();
}

/// What the runs that are no members say of the factors: one step of the search from where the fit of all runs ended. Half
/// of the runs move the factors by a standard error or so, and over that much the wheels' paths are linear in them.
WheelFactors found_without(const MlFit& fit, std::span<const std::size_t> members) {
  std::vector<InnovationSums> others;
  SharedInformation information = SharedInformation::Zero();
  for (std::size_t i = 0; i < fit.sums().size(); ++i) {
    if (contains(members, i)) continue;
    others.push_back(fit.sums()[i]);
    information += reduced(others.back(), fit.fixed(), 0).information;
  }
  const Unknowns found = fit.unknowns().front() + gauss_newton_step(others, fit.fixed(), 0).front();
  const WheelFactors factors{found[kCRight], found[kCLeft], found[kB]};
  const FactorCovariance covariance = shared_covariance(information, fit.fixed()).topLeftCorner<3, 3>();
  require_observed(errors_of(covariance, factors), factors);
  return factors;
}

/// The members of a group, with the unknowns that the fit of all runs gave them, where others begin.
struct Group {
  PreparedRuns prepared;
  std::vector<Unknowns> start;
};

Group group_of(const PreparedRuns& all, const MlFit& fit, std::span<const std::size_t> members) {
  Group out;
  for (const std::size_t i : members) {
    out.prepared.runs.push_back(all.runs[i]);
    out.prepared.clocks.push_back(all.clocks[i]);
    out.start.push_back(fit.unknowns()[i]);
  }
  return out;
}

/// How drives are followed with given factors; start poses, lever arm and clocks are fitted to the drives.
struct Followed {
  std::vector<RunErrors> errors;
  std::vector<double> cost;  // -2 log likelihood of each run
};

Followed followed(const Group& runs, const WheelFactors& factors, const MlOptions& options) {
  const MlFit fit(runs.prepared, factors, options, true, runs.start);
  Followed out{path_errors(fit, factors).runs, {}};
  for (const InnovationSums& sums : fit.sums()) out.cost.push_back(sums.cost);
  return out;
}

/// Drives that could not be held out may be those on which the factors would fail.
void judge(CrossValidation& out) {
  std::vector<double> gains;
  for (const HeldOutRun& run : out.runs) gains.push_back(run.gain);
  out.verdict = judge_gains(gains);
  if (out.verdict == Verdict::better && !out.not_judged.empty()) out.verdict = Verdict::unknown;
}

/// "without run 1 and run 3, the runs do not separate ...".
Remark not_judged(const std::vector<std::string>& held_out, const Error& error) {
  std::string names;
  for (std::size_t i = 0; i < held_out.size(); ++i)
    names += (i == 0 ? "" : i + 1 < held_out.size() ? ", " : " and ") + held_out[i];
  return {"without " + names + ", " + error.what(), error.remedy()};
}

HeldOutErrors root_mean_squares(const std::vector<HeldOutRun>& runs, RunErrors HeldOutRun::*which) {
  const auto over = [&](double RunErrors::*error) {
    double sum = 0, count = 0;
    for (const HeldOutRun& run : runs) {
      const double value = run.*which.*error;
      if (!std::isfinite(value)) continue;
      sum += value * value;
      ++count;
    }
    return std::sqrt(sum / count);
  };
  return {over(&RunErrors::final_m), over(&RunErrors::final_heading_rad), over(&RunErrors::path_rms_m)};
}

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

/// What is left of an end error with factors that foretell `expected` of it.
RunErrors left_of(const EndPose& end, const EndPose& expected, std::string name) {
  return {std::move(name), std::hypot(end.x_m - expected.x_m, end.y_m - expected.y_m),
          end.theta_rad - expected.theta_rad, std::numeric_limits<double>::quiet_NaN()};
}

/// -2 log likelihood of an end, but for what does not depend on the factors. No end is measured better than to a tenth of a
/// millimetre and of a milliradian, however little the ends of a simulation scatter.
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

HeldOutErrors CrossValidation::in_use() const { return root_mean_squares(runs, &HeldOutRun::in_use); }
HeldOutErrors CrossValidation::found() const { return root_mean_squares(runs, &HeldOutRun::found); }

int CrossValidation::better_on() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const HeldOutRun& run) { return run.gain > 0; }));
}

Verdict judge_gains(std::span<const double> gains) {
  const auto n = static_cast<double>(gains.size());
  if (gains.size() < 2) return Verdict::unknown;
  if (std::all_of(gains.begin(), gains.end(), [](double gain) { return gain == 0; }))
    return Verdict::undecided;
  double mean = 0, squares = 0;
  for (const double gain : gains) mean += gain / n;
  for (const double gain : gains) squares += (gain - mean) * (gain - mean);
  const int freedom = static_cast<int>(gains.size()) - 1 + kPriorRuns;
  const double variance = (squares + kPriorRuns * 4 * std::abs(mean)) / freedom;
  const double t = mean / std::sqrt(variance / n);
  if (std::isnan(t)) return Verdict::unknown;
  if (std::abs(t) <= student_t_90(freedom)) return Verdict::undecided;
  return t > 0 ? Verdict::better : Verdict::worse;
}

CrossValidation cross_validate(std::span<const Trajectory> runs, const WheelFactors& in_use,
                               const MlEstimate& all, const MlOptions& options) {
  CrossValidation out;
  MlOptions with_noise = options;
  with_noise.noise = all.noise;
  with_noise.stride = all.stride;
  const PreparedRuns prepared = prepare(runs, in_use, options.clock_known, Density::independent);
  const MlFit fit(prepared, in_use, with_noise);
  const std::size_t groups = std::min(kMostGroups, prepared.runs.size());
  for (std::size_t i = 0; i < groups && prepared.runs.size() > 1; ++i) {
    const std::vector<std::size_t> members = members_of(i, groups, prepared.runs.size());
    try {
      const WheelFactors found = found_without(fit, members);
      const Group held_out = group_of(prepared, fit, members);
      const Followed by_in_use = followed(held_out, in_use, with_noise);
      const Followed by_found = followed(held_out, found, with_noise);
      for (std::size_t k = 0; k < by_found.errors.size(); ++k)
        out.runs.push_back({by_in_use.errors.at(k), by_found.errors[k], found,
                            (by_in_use.cost.at(k) - by_found.cost[k]) / all.dispersion});
    } catch (const Error& error) {
      std::vector<std::string> names;
      for (const std::size_t member : members) names.push_back(prepared.runs[member].source->name);
      out.not_judged.push_back(not_judged(names, error));
    }
  }
  judge(out);
  return out;
}

CrossValidation cross_validate(std::span<const EndPose> cw, std::span<const EndPose> ccw, double side_m,
                               const WheelFactors& in_use, const Options& options) {
  CrossValidation out;
  if (cw.size() < 2 || ccw.size() < 2) {
    out.not_judged.push_back({"there are not two squares in each direction", {Help::drive_squares}});
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
      out.not_judged.push_back(not_judged({"squares " + std::to_string(i + 1)}, error));
    }
  }
  judge(out);
  return out;
}

void cross_validate_scale(std::span<const LineEnd> lines, const WheelFactors& in_use, const LineScale& scale,
                          CrossValidation& judged) {
  if (lines.size() < 2) {
    judged.not_judged.push_back({"the scale comes from a single line", {Help::drive_lines}});
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
  judge(judged);
}

}  // namespace astro::calibration
