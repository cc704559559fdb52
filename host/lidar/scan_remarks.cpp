#include "host/lidar/scan_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "host/base/text/degrees.hpp"

namespace astro::lidar {
namespace {

/// What the drives say of an unknown is no more than what was thought before them.
bool not_shown(const ScanCalibration& found, Unknown unknown) {
  constexpr double kOfPrior = 0.5;
  return std::sqrt(found.unknowns_covariance(unknown, unknown)) >
         kOfPrior * wide_prior(found.unknowns, true).deviation(unknown);
}

void add_missing_motions(const MountingFound& mounting, const ScanCalibration& found,
                         std::vector<Remark>& remarks) {
  const auto unless_shown = [&](Unknown unknown, ScanRemark kind, const char* sentence) {
    if (not_shown(found, unknown)) remarks.push_back({sentence, kind});
  };
  unless_shown(kTurn, ScanRemark::no_turns,
               "the drives do not show b: turns are missing, some whole ones to each side");
  unless_shown(kBend, ScanRemark::no_bend,
               "the drives do not show E_d: straight pieces of some metres are missing, or turns to both "
               "sides");
  unless_shown(kScale, ScanRemark::no_scale,
               "the drives do not show the scale: some metres straight on are missing, towards walls or past "
               "things that stick out");
  if (not_shown(found, kLeverX) || not_shown(found, kLeverY))
    remarks.push_back({"the drives do not show where the scanner sits: turns on the spot are missing",
                       ScanRemark::no_place});
  unless_shown(kLeverYaw, ScanRemark::no_yaw,
               "the drives do not show which way the scanner looks: the robot has to move on from its place");
  if (!shows_mirror_images(mounting))
    remarks.push_back(
        {"without turns it does not show whether the scans are a mirror image, which would turn "
         "E_d round",
         ScanRemark::mirror_unknown});
}

void add_count(std::size_t count, std::size_t of, double least_part, ScanRemark kind, const char* sentence,
               std::vector<Remark>& remarks) {
  if (count == 0 || static_cast<double>(count) < least_part * static_cast<double>(of)) return;
  remarks.push_back({fmt::format(fmt::runtime(sentence), count, of),
                     kind,
                     {fmt::format("{}", count), fmt::format("{}", of)}});
}

void add_counts(const ScanCounts& counts, std::vector<Remark>& remarks) {
  const std::size_t tried = counts.matched + counts.unmatched;
  add_count(counts.degenerate, counts.matched, 0.05, ScanRemark::one_direction,
            "in {} of {} matches the walls show the motion in one direction only, as in a corridor; these do "
            "not count along it",
            remarks);
  add_count(
      counts.unmatched, tried, 0.05, ScanRemark::unmatched,
      "{} of {} pairs of scans do not match: people may have walked by, scans may be lost, or the wheels "
      "slipped",
      remarks);
  add_count(counts.gaps, tried, 0.0, ScanRemark::gaps,
            "{} times the robot drove on by more than 2.5 m or turned by more than 1.2 rad without a scan; "
            "{} pairs of scans are nearer",
            remarks);
  add_count(counts.outside, counts.scans, 0.05, ScanRemark::outside,
            "{} of {} scans were made before or after the wheels were recorded", remarks);
}

struct Mean {
  double value = 0, error = 0;
};

Mean mean_of(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double n = static_cast<double>(values.size()), mean = sum / n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (n - 1) / n)};
}

void add_clocks(double late_spread_s, std::vector<Remark>& remarks) {
  if (late_spread_s == 0) return;
  const std::string by = fmt::format("{:.0f}", 1000 * late_spread_s);
  remarks.push_back(
      {fmt::format("the clocks of wheels and scans were up to {} ms further apart in some drives "
                   "than in others, so each drive has an offset of its own: one of them was set, or "
                   "both run at different rates",
                   by),
       ScanRemark::clocks_differ,
       {by}});
}

void add_drift(double clock_rate, std::vector<Remark>& remarks) {
  if (clock_rate == 0) return;
  const std::string by = fmt::format("{:.0f}", 1e6 * std::abs(clock_rate));
  remarks.push_back(
      {fmt::format(
           "the clocks of wheels and scans run at rates that differ by {} parts in a million, which is "
           "taken into account",
           by),
       ScanRemark::clock_drifts,
       {by}});
}

/// Matches over some metres against the chain of those in between: a bias of the matcher would look like one of the wheels. It is
/// told if it is clear, and larger than what the drives leave open of the bend.
void add_bias(std::span<const LongMatch> long_matches, double bend_error_radpm,
              std::vector<Remark>& remarks) {
  constexpr std::size_t kFewest = 10;
  constexpr double kClearly = 3;
  if (long_matches.size() < kFewest) return;
  std::vector<double> turned_radpm;
  for (const LongMatch& match : long_matches)
    turned_radpm.push_back(difference(match.direct, match.chained).theta_rad / match.length_m);
  const Mean bias = mean_of(turned_radpm);
  if (!(std::abs(bias.value) > std::max(kClearly * bias.error, bend_error_radpm))) return;
  const std::string by = fmt::format("{:.2f}", degrees(std::abs(bias.value)));
  remarks.push_back(
      {fmt::format("matches over some metres turn by {} degrees for each metre less or more than "
                   "the matches in between together: the scans themselves may be the cause of a "
                   "part of what was found",
                   by),
       ScanRemark::matcher_biased,
       {by}});
}

}  // namespace

std::vector<Remark> remarks_on(std::span<const LongMatch> long_matches, const MountingFound& mounting,
                               const ScanCalibration& found) {
  std::vector<Remark> remarks;
  add_missing_motions(mounting, found, remarks);
  add_counts(found.counts, remarks);
  add_clocks(found.late_spread_s, remarks);
  add_drift(found.clock_rate, remarks);
  add_bias(long_matches, std::sqrt(found.unknowns_covariance(kBend, kBend)), remarks);
  return remarks;
}

}  // namespace astro::lidar
