#include "host/calibration/judgement/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/calibration/judgement/student_t.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {
namespace {

constexpr std::size_t kMostGroups = 10;
constexpr int kPriorRuns = 4;

/// Every `groups`-th run, so that a group has runs of all kinds and senses, whether these were driven alternately or one after
/// the other.
std::vector<std::size_t> members_of(std::size_t index, std::size_t groups, std::size_t runs) {
  std::vector<std::size_t> members;
  for (std::size_t i = index; i < runs; i += groups) members.push_back(i);
  return members;
}

bool contains(std::span<const std::size_t> members, std::size_t run) {
  return std::find(members.begin(), members.end(), run) != members.end();
}

/// The information of all runs but the members of a group.
Pool without(const MlFit& fit, std::span<const std::size_t> members) {
  Pool others(fit.fixed(), fit.prior());
  for (std::size_t i = 0; i < fit.sums().size(); ++i) {
    others.know(fit.sums()[i].session);
    if (!contains(members, i)) others.add(reduced(fit.sums()[i], fit.fixed(), 0));
  }
  return others;
}

/// The factors by the other runs: one step of the search from where the fit of all runs ended. Half
/// of the runs move the factors by a standard error or so, and over that much the wheels' paths are linear in them.
WheelFactors found_by(const Pool& others, const MlFit& fit) {
  Unknowns found = fit.unknowns().front();
  found.head<kFactors>() += others.factor_step();
  const WheelFactors factors = factors_of(found);
  require_observed(errors_of(others.factor_covariance(), factors), factors);
  return factors;
}

/// The members of a group, with the unknowns at which their fits begin: those of the fit of all runs, but with the lever arm
/// and the skew that the other runs give.
struct Group {
  PreparedRuns prepared;
  std::vector<Unknowns> start;
};

Group group_of(const PreparedRuns& all, const MlFit& fit, const Pool& others,
               std::span<const std::size_t> members) {
  Group out;
  for (const std::size_t i : members) {
    out.prepared.runs.push_back(all.runs[i]);
    out.prepared.clocks.push_back(all.clocks[i]);
    out.start.push_back(fit.unknowns()[i]);
    out.start.back().segment<kOfSession>(kFactors) += others.step(all.runs[i].session).tail<kOfSession>();
  }
  return out;
}

/// Whether other runs know the lever arms and the skews of the members better than these do themselves.
bool sessions_are_known(const PreparedRuns& all, std::span<const std::size_t> members) {
  constexpr int kEnough = 3;
  return std::all_of(members.begin(), members.end(), [&](std::size_t member) {
    int others = 0;
    for (std::size_t i = 0; i < all.runs.size(); ++i)
      if (!contains(members, i) && all.runs[i].session == all.runs[member].session) ++others;
    return others >= kEnough;
  });
}

/// How drives are followed with given factors; start poses and clock offsets are fitted to the drives, and so are lever arm and
/// skew where other drives do not know them well.
struct Followed {
  std::vector<RunErrors> errors;
  std::vector<double> cost;  // -2 log likelihood of each run
};

Followed followed(const Group& runs, const WheelFactors& factors, const MlOptions& options,
                  const FixedParameters& held) {
  const MlFit fit = MlFit::of(runs.prepared, factors, options, held, runs.start);
  Followed out{path_errors(fit, factors).runs, {}};
  for (const InnovationSums& sums : fit.sums()) out.cost.push_back(sums.cost);
  return out;
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

}  // namespace

HeldOutErrors CrossValidation::in_use() const { return root_mean_squares(runs, &HeldOutRun::in_use); }
HeldOutErrors CrossValidation::found() const { return root_mean_squares(runs, &HeldOutRun::found); }

int CrossValidation::better_on() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const HeldOutRun& run) { return run.gain > 0; }));
}

// If drives could not be held out, the verdict is not `better`, because the factors may fail on just these
// drives.
void CrossValidation::judge() {
  std::vector<double> gains;
  for (const HeldOutRun& run : runs) gains.push_back(run.gain);
  verdict = judge_gains(gains);
  if (verdict == Verdict::better && !not_judged.empty()) verdict = Verdict::unknown;
}

Remark CrossValidation::without(const std::vector<std::string>& held_out, const Error& error) {
  std::string names;
  for (std::size_t i = 0; i < held_out.size(); ++i)
    names += (i == 0 ? "" : i + 1 < held_out.size() ? ", " : " and ") + held_out[i];
  Remark clause = error.in("without " + names + ", ");
  clause.values.insert(clause.values.end(), held_out.begin(), held_out.end());
  return clause;
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
  with_noise.spacing_m = all.spacing_m;
  with_noise.widening = all.widening;
  const PreparedRuns prepared = prepare(runs, in_use, options.clock_known, Density::independent);
  const MlFit fit = MlFit::of(prepared, in_use, with_noise);
  const MlFit fit_in_use = MlFit::of(prepared, in_use, with_noise, {.factors = true}, fit.unknowns());
  const std::size_t groups = std::min(kMostGroups, prepared.runs.size());
  for (std::size_t i = 0; i < groups && prepared.runs.size() > 1; ++i) {
    const std::vector<std::size_t> members = members_of(i, groups, prepared.runs.size());
    try {
      const Pool others = without(fit, members);
      const WheelFactors found = found_by(others, fit);
      const FixedParameters held{.factors = true, .session = sessions_are_known(prepared, members)};
      const Followed by_found = followed(group_of(prepared, fit, others, members), found, with_noise, held);
      const Pool others_in_use = without(fit_in_use, members);
      const Followed by_in_use =
          followed(group_of(prepared, fit_in_use, others_in_use, members), in_use, with_noise, held);
      for (std::size_t k = 0; k < by_found.errors.size(); ++k)
        out.runs.push_back({by_in_use.errors.at(k), by_found.errors[k], found,
                            (by_in_use.cost.at(k) - by_found.cost[k]) / all.widening});
    } catch (const Error& error) {
      std::vector<std::string> names;
      for (const std::size_t member : members) names.push_back(prepared.runs[member].source->name);
      out.not_judged.push_back(CrossValidation::without(names, error));
    }
  }
  out.judge();
  return out;
}

}  // namespace astro::calibration
