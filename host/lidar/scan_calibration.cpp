#include "host/lidar/scan_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <vector>

#include "host/lidar/mounting_search.hpp"
#include "host/lidar/scan_remarks.hpp"

namespace astro::lidar {
namespace {

constexpr std::size_t kFewestMatches = 10;

/// What all drives show, with the scanner thought to sit as `start` says.
struct Matched {
  std::vector<Stretch> stretches;
  std::vector<std::size_t> ends;  // of each drive: how many stretches there are up to its end
  std::vector<LongMatch> long_matches;
  ScanCounts counts;
};

Matched match_all(std::span<const ScannedDrive> drives, const calibration::WheelFactors& loaded,
                  const Unknowns& start, bool mirrored) {
  Matched all;
  for (const ScannedDrive& drive : drives) {
    Keyframes keyframes = keyframes_of(drive, loaded, start, mirrored);
    std::move(keyframes.stretches.begin(), keyframes.stretches.end(), std::back_inserter(all.stretches));
    all.ends.push_back(all.stretches.size());
    all.long_matches.insert(all.long_matches.end(), keyframes.long_matches.begin(),
                            keyframes.long_matches.end());
    all.counts += keyframes.counts;
  }
  return all;
}

void require_matches(const ScanCounts& counts) {
  if (counts.scans == counts.outside)
    throw Error(fmt::format("none of the {} scans was made while the wheels were recorded", counts.scans),
                ScanProblem::no_common_time, {fmt::format("{}", counts.scans)});
  if (counts.matched >= kFewestMatches && counts.matched > counts.unmatched / 2) return;
  const std::size_t tried = counts.matched + counts.unmatched;
  throw Error(fmt::format("only {} of {} pairs of scans match as the wheels moved between them: scans may be "
                          "lost, or not be those of this drive",
                          counts.matched, tried),
              ScanProblem::do_not_match, {fmt::format("{}", counts.matched), fmt::format("{}", tried)});
}

/// Whether the scanner's place or clock differs so much from what the scans were matched with that they should be matched anew.
bool elsewhere(const Unknowns& found, const Unknowns& start) {
  const Unknowns off = (found - start).cwiseAbs();
  return off(kLeverX) > 0.15 || off(kLeverY) > 0.15 || off(kLeverYaw) > 0.1 || off(kLate) > 0.02;
}

struct Lateness {
  double later_s = 0, se_s = 0;  // than by the offset of all drives
};

/// Of some stretches of one drive. Their factors may be a bit others than those of all drives: on another floor the wheelbase is, and
/// its residuals are not the clock's.
Lateness lateness_of(std::span<const LinearStretch> stretches, const IteratedFit& all) {
  Prior prior = FactorSet{"", false, false, false}.prior(all.fit.unknowns, true);
  for (const Unknown place : {kLeverX, kLeverY, kLeverYaw}) prior.deviation(place) = 0;
  const StretchFit own = fit(stretches, all.at, prior);
  return {own.unknowns(kLate) - all.fit.unknowns(kLate), std::sqrt(own.covariance(kLate, kLate))};
}

/// The scans' stamps of one drive against those of all: in the middle of the drive, and by how much more with each second. 0 unless
/// that is clear: another computer's clock may have been set between two drives, or runs at another rate.
struct ClockError {
  double later_s = 0, rate = 0;
};

/// drifts: it is clear already that the rates differ, so that what is left of that is found, too.
ClockError clock_error(std::span<const LinearStretch> of_drive, std::span<const Stretch> stretches,
                       const IteratedFit& all, bool drifts) {
  constexpr std::size_t kFewest = 10;
  constexpr double kClearly = 4, kLeast_s = 0.003, kSettled_s = 0.001;
  ClockError error;
  if (of_drive.size() < kFewest) return error;
  const Lateness whole = lateness_of(of_drive, all);
  if (std::abs(whole.later_s) > std::max(kLeast_s, kClearly * whole.se_s)) error.later_s = whole.later_s;
  if (of_drive.size() < 2 * kFewest) return error;
  const std::size_t half = of_drive.size() / 2;
  const Lateness first = lateness_of(of_drive.first(half), all),
                 second = lateness_of(of_drive.subspan(half), all);
  const double more_s = second.later_s - first.later_s,
               apart_s =
                   (stretches[of_drive.back().index].to_s - stretches[of_drive.front().index].from_s) / 2;
  const double clearly_s = std::max(2 * kLeast_s, kClearly * std::hypot(first.se_s, second.se_s));
  if (std::abs(more_s) > (drifts ? kSettled_s : clearly_s)) error.rate = more_s / apart_s;
  return error;
}

/// Of each drive. `so_far`: what was found of it before.
std::vector<ClockError> clock_errors(const Matched& matched, const IteratedFit& all,
                                     std::span<const ClockError> so_far) {
  std::vector<ClockError> errors;
  auto begin = all.stretches.begin();
  for (const std::size_t end_index : matched.ends) {
    const auto end =
        std::ranges::lower_bound(begin, all.stretches.end(), end_index, {}, &LinearStretch::index);
    errors.push_back(clock_error({begin, end}, matched.stretches, all, so_far[errors.size()].rate != 0));
    begin = end;
  }
  return errors;
}

/// Puts the wheels of each drive onto the clock of its scans, but for the offset that all drives share. `so_far`: of each drive, to
/// which `errors` are added. False if there is nothing to do.
bool put_on_one_clock(std::span<ScannedDrive> drives, std::span<const ClockError> errors,
                      std::vector<ClockError>& so_far) {
  for (std::size_t i = 0; i < errors.size(); ++i) {
    std::vector<calibration::WheelSample>& wheels = drives[i].wheels;
    const double middle_s = (wheels.front().time_s + wheels.back().time_s) / 2;
    for (calibration::WheelSample& sample : wheels)
      sample.time_s += errors[i].later_s + errors[i].rate * (sample.time_s - middle_s);
    so_far[i].later_s += errors[i].later_s;
    so_far[i].rate += errors[i].rate;
  }
  return std::ranges::any_of(errors, [](const ClockError& one) { return one.later_s != 0 || one.rate != 0; });
}

/// By the derivatives of c_R, c_L, b and e.
Eigen::Matrix4d factor_covariance(const Unknowns& unknowns, const Information& covariance,
                                  const calibration::WheelFactors& loaded) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, 4, kUnknowns> by_unknowns;
  for (int k = 0; k < kUnknowns; ++k) {
    Unknowns more = unknowns, less = unknowns;
    more(k) += kStep;
    less(k) -= kStep;
    const calibration::WheelFactors a = factors_of(less, loaded), b = factors_of(more, loaded);
    by_unknowns.col(k) =
        Eigen::Vector4d{b.c_r - a.c_r, b.c_l - a.c_l, b.b_m - a.b_m, b.e - a.e} / (2 * kStep);
  }
  return by_unknowns * covariance * by_unknowns.transpose();
}

/// Of all stretches, with the scanner where it was found in both cases: its place belongs to the scans and not to odometry.
std::vector<StretchResidual> residuals_of(std::span<const Stretch> stretches, const Unknowns& found,
                                          const calibration::WheelFactors& loaded) {
  Unknowns as_loaded = nothing_wrong(loaded);
  for (const Unknown place : {kLeverX, kLeverY, kLeverYaw, kLate}) as_loaded(place) = found(place);
  std::vector<StretchResidual> residuals;
  std::size_t drives = 0;
  double way_m = 0;
  for (const Stretch& stretch : stretches) {
    if (stretch.new_drive) ++drives;
    if (!stretch.scanner) continue;
    const Pose2& seen = stretch.scanner->motion;
    if (!stretch.scanner->degenerate)
      residuals.push_back({drives - 1, way_m, difference(seen, predicted(stretch, as_loaded, loaded)),
                           difference(seen, predicted(stretch, found, loaded))});
    way_m += std::hypot(seen.x_m, seen.y_m);
  }
  return residuals;
}

void state_clocks(std::span<const ClockError> clocks, double late_s, ScanCalibration& found) {
  const auto [earliest, latest] = std::ranges::minmax(clocks, {}, &ClockError::later_s);
  found.late_spread_s = latest.later_s - earliest.later_s;
  double sum_s = 0;
  for (const ClockError& clock : clocks) {
    sum_s += clock.later_s;
    if (std::abs(clock.rate) > std::abs(found.clock_rate)) found.clock_rate = clock.rate;
  }
  found.late_s = late_s + sum_s / static_cast<double>(clocks.size());
}

/// What is held out follows the order of the drives, so that they are taken in one of their own, whatever order they come in.
std::vector<ScannedDrive> in_order(std::span<const ScannedDrive> drives) {
  std::vector<ScannedDrive> ordered(drives.begin(), drives.end());
  const auto key = [](const ScannedDrive& drive) {
    const calibration::WheelSample first = drive.wheels.empty() ? calibration::WheelSample{}
                                                                : drive.wheels.front(),
                                   last = drive.wheels.empty() ? calibration::WheelSample{}
                                                               : drive.wheels.back();
    return std::tuple(drive.origin_ns, first.time_s, last.time_s, last.right_m, last.left_m);
  };
  std::ranges::sort(ordered, {}, key);
  return ordered;
}

}  // namespace

ScanCalibration calibrate_by_scans(std::span<const ScannedDrive> given,
                                   const calibration::WheelFactors& loaded, bool mirrored) {
  std::vector<ScannedDrive> drives = in_order(given);
  std::vector<ClockError> clocks(drives.size());
  constexpr int kMostTimes = 4;
  const bool late = std::all_of(drives.begin(), drives.end(),
                                [](const ScannedDrive& drive) { return drive.times_measured; });
  const MountingFound mounting = require_mounting(drives, loaded, mirrored);
  Unknowns start = nothing_wrong(loaded);
  start(kLeverYaw) = mounting.yaw_rad;
  ScanCalibration found;
  found.loaded = loaded;
  Matched matched;
  IteratedFit all;
  for (int time = 0; time < kMostTimes; ++time) {
    matched = match_all(drives, loaded, start, mirrored);
    require_matches(matched.counts);
    all = iterated_fit(matched.stretches, wide_prior(start, late), loaded);
    if (time + 1 == kMostTimes) break;
    const bool other_clocks = late && put_on_one_clock(drives, clock_errors(matched, all, clocks), clocks);
    if (!other_clocks && !elsewhere(all.fit.unknowns, start)) break;
    for (const Unknown place : {kLeverX, kLeverY, kLeverYaw, kLate}) start(place) = all.fit.unknowns(place);
  }
  found.choice = choose_factors(matched.stretches, all.stretches, all.at, start, late, loaded);
  found.judged = can_be_judged(found.choice) && shows_mirror_images(mounting);
  found.counts = matched.counts;
  found.unknowns = all.fit.unknowns;
  found.unknowns_covariance = all.fit.covariance;
  const StretchFit used =
      can_be_judged(found.choice) ? fit(all.stretches, all.at, found.choice.set.prior(start, late)) : all.fit;
  found.factors = factors_of(used.unknowns, loaded);
  found.covariance = factor_covariance(used.unknowns, used.covariance, loaded);
  found.scanner = lever_of(used.unknowns);
  const auto error = [&](Unknown k) { return std::sqrt(used.covariance(k, k)); };
  found.scanner_se = {error(kLeverX), error(kLeverY), error(kLeverYaw)};
  state_clocks(clocks, used.unknowns(kLate), found);
  found.late_se_s = late ? error(kLate) : std::numeric_limits<double>::quiet_NaN();
  found.residuals = residuals_of(matched.stretches, used.unknowns, loaded);
  found.remarks = remarks_on(matched.long_matches, mounting, found);
  return found;
}

}  // namespace astro::lidar
