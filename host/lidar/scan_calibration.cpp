#include "host/lidar/scan_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
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

/// By how much later the scans' stamps are in each drive than in all of them together; 0 unless that is clear. Another computer's clock
/// may have been set between two drives, or runs at another rate.
std::vector<double> clock_jumps(const Matched& matched, const IteratedFit& all) {
  constexpr std::size_t kFewest = 10;
  constexpr double kClearly = 4, kLeast_s = 0.003;
  Freedom stamps_alone{};
  stamps_alone[kLate] = true;
  std::vector<double> jumps;
  auto begin = all.stretches.begin();
  for (const std::size_t end_index : matched.ends) {
    const auto end =
        std::ranges::lower_bound(begin, all.stretches.end(), end_index, {}, &LinearStretch::index);
    const std::span<const LinearStretch> of_drive(begin, end);
    begin = end;
    jumps.push_back(0);
    if (of_drive.size() < kFewest) continue;
    const StretchFit own = fit(of_drive, all.at, all.fit.unknowns, stamps_alone);
    const double later_s = own.unknowns(kLate) - all.fit.unknowns(kLate);
    if (std::abs(later_s) > std::max(kLeast_s, kClearly * std::sqrt(own.covariance(kLate, kLate))))
      jumps.back() = later_s;
  }
  return jumps;
}

/// Puts the scans of each drive, whose own offset is in `later_s`, onto one clock. False if there is nothing to do.
bool put_on_one_clock(std::span<ScannedDrive> drives, std::span<const double> jumps,
                      std::vector<double>& later_s) {
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    drives[i].origin_ns += std::llround(1e9 * jumps[i]);
    later_s[i] += jumps[i];
  }
  return std::ranges::any_of(jumps, [](double jump_s) { return jump_s != 0; });
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

Freedom all_free(bool late) { return FactorSet{"", true, true, true}.freedom(late); }

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
  std::vector<double> later_s(drives.size());  // the stamps of each drive
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
    all = iterated_fit(matched.stretches, start, all_free(late), loaded);
    if (time + 1 == kMostTimes) break;
    const bool jumped =
        late && drives.size() > 1 && put_on_one_clock(drives, clock_jumps(matched, all), later_s);
    if (!jumped && !elsewhere(all.fit.unknowns, start)) break;
    for (const Unknown place : {kLeverX, kLeverY, kLeverYaw, kLate}) start(place) = all.fit.unknowns(place);
  }
  found.choice = choose_factors(matched.stretches, all.stretches, all.at, start, late, loaded);
  found.judged = can_be_judged(found.choice) && shows_mirror_images(mounting);
  found.counts = matched.counts;
  found.unknowns = all.fit.unknowns;
  found.unknowns_covariance = all.fit.covariance;
  const Freedom chosen = can_be_judged(found.choice) ? found.choice.set.freedom(late) : all_free(late);
  const Unknowns used = fit(all.stretches, all.at, start, chosen).unknowns;
  found.factors = factors_of(used, loaded);
  // Factors that stay as loaded are off by what the drives say of them, and by what the drives leave open.
  const Unknowns kept = all.fit.unknowns - used;
  found.covariance = factor_covariance(used, all.fit.covariance + kept * kept.transpose(), loaded);
  found.scanner = lever_of(used);
  const auto error = [&](Unknown k) { return std::sqrt(all.fit.covariance(k, k)); };
  found.scanner_se = {error(kLeverX), error(kLeverY), error(kLeverYaw)};
  const auto [earliest, latest] = std::ranges::minmax(later_s);
  found.late_spread_s = latest - earliest;
  found.late_s = used(kLate) +
                 std::accumulate(later_s.begin(), later_s.end(), 0.0) / static_cast<double>(later_s.size());
  found.late_se_s = late ? error(kLate) : std::numeric_limits<double>::quiet_NaN();
  found.residuals = residuals_of(matched.stretches, used, loaded);
  found.remarks = remarks_on(matched.long_matches, mounting, found);
  return found;
}

}  // namespace astro::lidar
