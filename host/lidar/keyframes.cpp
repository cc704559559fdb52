#include "host/lidar/keyframes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/lidar/driven_surface.hpp"
#include "host/lidar/pair_match.hpp"

namespace astro::lidar {
namespace {

constexpr double kApart_m = 0.4, kApart_rad = 0.35;   // keyframes
constexpr double kTooFar_m = 2.5, kTooFar_rad = 1.2;  // neighbours no longer show enough of the same walls
constexpr double kLong_m = 3;

struct Moved {
  double length_m, turned_rad;
  bool beyond(double length, double turned) const {
    return std::abs(length_m) > length || std::abs(turned_rad) > turned;
  }
};

Moved moved(const calibration::WheelState& from, const calibration::WheelState& to,
            const calibration::WheelFactors& loaded) {
  const double right_m = loaded.c_r * (to.right_m - from.right_m),
               left_m = loaded.c_l * (to.left_m - from.left_m);
  return {(right_m + left_m) / 2, (right_m - left_m) / loaded.b_m};
}

bool slipped(const ScannedDrive& drive, double from_s, double to_s) {
  return std::ranges::any_of(
      drive.slips, [&](const calibration::Slip& slip) { return slip.begin_s < to_s && slip.end_s > from_s; });
}

}  // namespace

ScanCounts& ScanCounts::operator+=(const ScanCounts& other) {
  for (const auto count :
       {&ScanCounts::scans, &ScanCounts::outside, &ScanCounts::matched, &ScanCounts::degenerate,
        &ScanCounts::unmatched, &ScanCounts::gaps, &ScanCounts::slipped})
    this->*count += other.*count;
  return *this;
}

Keyframes::Keyframes(const ScannedDrive& drive, const calibration::WheelFactors& loaded,
                     const Unknowns& start, bool mirrored)
    : drive_(drive), loaded_(loaded), start_(start), mirrored_(mirrored), path_(drive.wheels) {}

void Keyframes::add(const Scan& scan) {
  ++counts.scans;
  const double time_s = drive_.seconds(scan), on_wheels_s = time_s - start_(kLate);
  if (!(on_wheels_s >= drive_.wheels.front().time_s && on_wheels_s <= drive_.wheels.back().time_s)) {
    ++counts.outside;
    return;
  }
  const calibration::WheelState wheels = path_.at(on_wheels_s);
  if (last_ && !moved(last_->wheels, wheels, loaded_).beyond(kApart_m, kApart_rad)) return;
  std::vector<SurfacePoint> points = driven_surface(drive_, scan, loaded_, start_, mirrored_);
  NearestPoints arranged(points);
  if (last_) check_long(add_stretch(time_s, wheels, points), arranged);
  last_ = {time_s, wheels, std::move(arranged)};
}

std::optional<ScanMatch> Keyframes::add_stretch(double time_s, const calibration::WheelState& wheels,
                                                std::span<const SurfacePoint> points) {
  Stretch stretch = cut_stretch(drive_.wheels, loaded_, last_->time_s, time_s, start_(kLate));
  stretch.new_drive = stretches.empty();
  std::optional<ScanMatch> found;
  if (moved(last_->wheels, wheels, loaded_).beyond(kTooFar_m, kTooFar_rad)) {
    ++counts.gaps;
  } else if (slipped(drive_, last_->time_s - start_(kLate), time_s - start_(kLate))) {
    ++counts.slipped;
  } else {
    found = trusted_match(last_->surface, points, predicted(stretch, start_, loaded_));
    ++(found ? counts.matched : counts.unmatched);
  }
  if (found) {
    stretch.scanner = {found->motion, found->covariance, found->degenerate()};
    if (found->degenerate()) ++counts.degenerate;
  }
  stretches.push_back(std::move(stretch));
  return found;
}

void Keyframes::check_long(const std::optional<ScanMatch>& found, const NearestPoints& surface) {
  if (!anchor_ || !found || found->degenerate()) {
    anchor_ = {surface, {}, 0};
    return;
  }
  anchor_->since = anchor_->since * found->motion;
  anchor_->length_m += std::hypot(found->motion.x_m, found->motion.y_m);
  if (anchor_->length_m < kLong_m) return;
  if (const auto direct = trusted_match(anchor_->surface, surface.points(), anchor_->since);
      direct && !direct->degenerate())
    long_matches.push_back({direct->motion, anchor_->since, anchor_->length_m});
  anchor_ = {surface, {}, 0};
}

Keyframes keyframes_of(const ScannedDrive& drive, const calibration::WheelFactors& loaded,
                       const Unknowns& start, bool mirrored) {
  Keyframes keyframes(drive, loaded, start, mirrored);
  drive.read_scans([&](const Scan& scan) { keyframes.add(scan); });
  return keyframes;
}

}  // namespace astro::lidar
