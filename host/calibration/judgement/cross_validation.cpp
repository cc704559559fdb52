#include "host/calibration/judgement/cross_validation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/parallel.hpp"
#include "host/calibration/judgement/held_out_factors.hpp"
#include "host/calibration/judgement/remarks.hpp"
#include "host/calibration/judgement/student_t.hpp"
#include "host/calibration/likelihood/day_drift.hpp"
#include "host/calibration/likelihood/ml_fit.hpp"
#include "host/calibration/preparation/preparation.hpp"

namespace astro::calibration {
namespace {

constexpr std::size_t kMostGroups = 10;

/// The runs of each group, every tenth of the runs in the order of their turns, so that a group has runs of both senses. The
/// order in which the runs are given does not matter: ties are broken by where the runs end.
std::vector<std::vector<std::size_t>> groups_of(const PreparedRuns& prepared) {
  std::vector<std::size_t> order(prepared.runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t run) {
    const WheelSample& end = prepared.runs[run].source->wheels.back();
    const BodySample& body = prepared.runs[run].truth.back();
    return std::array{end.right_m - end.left_m, end.right_m + end.left_m, body.x_m, body.y_m};
  };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<std::vector<std::size_t>> groups(order.size() > 1 ? std::min(kMostGroups, order.size()) : 0);
  for (std::size_t i = 0; i < order.size() && !groups.empty(); ++i)
    groups[i % groups.size()].push_back(order[i]);
  return groups;
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

WheelFactors factors_of(const FactorVector& factors) {
  return {factors[kCRight], factors[kCLeft], factors[kB], factors[kE]};
}

FactorVector vector_of(const WheelFactors& factors) {
  return {factors.c_r, factors.c_l, factors.b_m, factors.e};
}

/// A group of runs that is held out together.
struct HeldOut {
  std::vector<std::size_t> members;
  /// Whether the other runs determine the factors, so that the lever arm and the skew that they give are usable.
  bool determined = true;
};

/// The members of a group, with the unknowns at which their fits begin: those of the fit of all runs, but with the lever arm
/// and the skew that the other runs give.
struct Group {
  PreparedRuns prepared;
  std::vector<Unknowns> start;
};

Group group_of(const PreparedRuns& all, const MlFit& fit, const HeldOut& held_out) {
  const Pool others = without(fit, held_out.members);
  Group out;
  for (const std::size_t i : held_out.members) {
    out.prepared.runs.push_back(all.runs[i]);
    out.prepared.clocks.push_back(all.clocks[i]);
    out.start.push_back(fit.unknowns()[i]);
    if (held_out.determined)
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

std::vector<std::string> names_of(const PreparedRuns& prepared, std::span<const std::size_t> members) {
  std::vector<std::string> names;
  for (const std::size_t member : members) names.push_back(prepared.runs[member].source->name);
  return names;
}

/// Whether the factors, uncertain as they are, must be expected to do worse than those in use on motions that these runs do not
/// contain: circles in one direction alone fit well with many wheelbases. The square of the change is the square of the error
/// in use plus the variance, on average.
bool may_be_worse_elsewhere(const MlEstimate& all, const FactorVector& change) {
  return expected_end_error_m2(change * change.transpose(), all.factors) <
         2 * expected_end_error_m2(all.covariance, all.factors);
}

/// Holds out one group of runs after the other.
class HoldOut {
 public:
  /// `drives` must outlive it.
  HoldOut(const FittedDrives& drives, const WheelFactors& in_use, const MlEstimate& all,
          const MlOptions& options)
      : prepared_(drives.prepared),
        in_use_(in_use),
        options_(options),
        widening_(all.widening),
        fit_(MlFit::of(prepared_, in_use, options, {}, drives.unknowns)),
        fit_in_use_(MlFit::of(prepared_, in_use, options, {.factors = true}, fit_.unknowns())),
        whole_(without(fit_, {})),
        judged_(prepared_.runs.size()) {}

  /// From the factors in use to those of all runs.
  FactorVector change() const { return fit_.unknowns().front().head<kFactors>() - vector_of(in_use_); }

  /// Of a group that could not be judged: why, and the gains to expect of its members. Nothing of one that was.
  struct NotJudged {
    std::optional<Remark> why;
    double claimed = 0;
  };
  NotJudged hold_out(std::span<const std::size_t> members);
  /// Those that could be judged, in the order of the runs.
  std::vector<HeldOutRun> judged() const;

 private:
  void judge(const HeldOut& group, const HeldOutFactors& without_it);

  const PreparedRuns& prepared_;
  WheelFactors in_use_;
  MlOptions options_;
  double widening_;
  MlFit fit_, fit_in_use_;
  Pool whole_;
  std::vector<std::optional<HeldOutRun>> judged_;
};

HoldOut::NotJudged HoldOut::hold_out(std::span<const std::size_t> members) {
  const HeldOutFactors without_it = held_out_factors(whole_, without(fit_, members), change());
  if (without_it.not_judged > widening_ * chi_square_95(without_it.undetermined)) {
    return {CrossValidation::known_by_these_alone(names_of(prepared_, members)),
            (without_it.judged + without_it.not_judged) / widening_};
  }
  try {
    judge({{members.begin(), members.end()}, without_it.undetermined == 0}, without_it);
  } catch (const Error& error) {
    return {CrossValidation::without(names_of(prepared_, members), error)};
  }
  return {};
}

void HoldOut::judge(const HeldOut& group, const HeldOutFactors& without_it) {
  const WheelFactors found = factors_of(FactorVector(vector_of(in_use_) + without_it.change));
  const FixedParameters held{.factors = true,
                             .session = group.determined && sessions_are_known(prepared_, group.members)};
  const Followed by_found = followed(group_of(prepared_, fit_, group), found, options_, held);
  const Followed by_in_use = followed(group_of(prepared_, fit_in_use_, group), in_use_, options_, held);
  const double claimed = without_it.judged / widening_ / static_cast<double>(group.members.size());
  for (std::size_t k = 0; k < group.members.size(); ++k)
    judged_[group.members[k]] = {by_in_use.errors.at(k), by_found.errors.at(k), found,
                                 (by_in_use.cost.at(k) - by_found.cost.at(k)) / widening_, claimed};
}

std::vector<HeldOutRun> HoldOut::judged() const {
  std::vector<HeldOutRun> runs;
  for (const std::optional<HeldOutRun>& run : judged_)
    if (run) runs.push_back(*run);
  return runs;
}

void weigh_against_drift(const MlEstimate& all, const WheelFactors& in_use, bool scale_known,
                         CrossValidation& out) {
  std::vector<int> shown{kRatio, kBaseOverScale};
  if (scale_known) shown.push_back(kScale);
  if (all.covariance(kE, kE) > 0) shown.push_back(kRatioE);  // otherwise it is held
  const Eigen::MatrixXd jacobian = ratios_by_factors(all.factors)(shown, Eigen::all);
  out.weigh_against_drift(jacobian * (vector_of(all.factors) - vector_of(in_use)),
                          jacobian * all.covariance * jacobian.transpose(),
                          jacobian * all.covariance_another_day * jacobian.transpose());
}

}  // namespace

CrossValidation cross_validate(std::span<const Trajectory> runs, const WheelFactors& in_use,
                               const MlEstimate& all, const MlOptions& options, bool scale_known) {
  return cross_validate(FittedDrives{prepare(runs, in_use, options.clock_known, Density::independent), {}},
                        in_use, all, options, scale_known);
}

CrossValidation cross_validate(const FittedDrives& drives, const WheelFactors& in_use, const MlEstimate& all,
                               const MlOptions& options, bool scale_known) {
  MlOptions with_noise = options;
  with_noise.noise = all.noise;
  with_noise.spacing_m = all.spacing_m;
  with_noise.widening = all.widening;
  HoldOut hold_out(drives, in_use, all, with_noise);
  CrossValidation out;
  const std::vector<std::vector<std::size_t>> groups = groups_of(drives.prepared);
  std::vector<HoldOut::NotJudged> not_judged(groups.size());
  in_parallel(static_cast<int>(groups.size()), [&](int i) {
    const auto group = static_cast<std::size_t>(i);
    not_judged[group] = hold_out.hold_out(groups[group]);
  });
  for (const HoldOut::NotJudged& group : not_judged) {
    if (group.why) out.not_judged.push_back(*group.why);
    out.claimed_elsewhere += group.claimed;
  }
  out.runs = hold_out.judged();
  out.judge();
  weigh_against_drift(all, in_use, scale_known, out);
  if (out.verdict == Verdict::better && may_be_worse_elsewhere(all, hold_out.change())) {
    out.verdict = Verdict::unknown;
    out.not_judged.push_back(
        {"it fits these drives better, but it is too uncertain for other motions: drive lines, and turns in "
         "both directions",
         JudgementProblem::uncertain_elsewhere});
  }
  return out;
}

}  // namespace astro::calibration
