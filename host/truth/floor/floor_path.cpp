#include "host/truth/floor/floor_path.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "host/base/error.hpp"
#include "host/base/microseconds.hpp"
#include "host/base/text/degrees.hpp"
#include "host/base/text/numbers.hpp"

namespace astro::truth {
namespace {

std::string text_of(const Direction3& v) {
  const auto shown = [](double value) { return without_minus_zero(value, 2); };
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", shown(v[0]), shown(v[1]), shown(v[2]));
}

[[noreturn]] void refuse_frames(const BodyTrack& track, const UpAxisEvidence& evidence) {
  const std::string normal = text_of(*evidence.by_positions), axis = text_of(*evidence.by_rotations);
  const std::string apart = fmt::format("{:.0f}", degrees(evidence.disagreement_rad));
  throw Error(
      fmt::format("'{}': positions and orientations are in different frames: the positions lie in a plane "
                  "with the normal {}, the body turns about {}, {} degrees apart: export positions and "
                  "orientations with the same axes, and do not change them afterwards",
                  track.name, normal, axis, apart),
      FloorProblem::frames_differ, {track.name, normal, axis, apart});
}

Direction3 known_up(const BodyTrack& track, const FloorChoices& choices, FloorFindings& findings) {
  findings.evidence = find_up_axis(track);
  const UpAxisEvidence& evidence = findings.evidence;
  if (choices.up) {
    findings.up_given = true;
    const Direction3& up = *choices.up;
    const double length = std::hypot(up[0], up[1], up[2]);
    if (!(length > 0)) throw Error("the up axis " + text_of(up) + " has no direction");
    return {up[0] / length, up[1] / length, up[2] / length};
  }
  if (evidence.by_positions && evidence.by_rotations && evidence.disagreement_rad > kLargestDisagreement_rad)
    refuse_frames(track, evidence);
  if (evidence.by_positions) return *evidence.by_positions;
  if (evidence.by_rotations) return *evidence.by_rotations;
  if (track.facts.rotation_kind == RotationKind::heading) return {0, 0, 1};
  throw Error(
      (track.name.empty() ? "the recording" : "'" + track.name + "'") +
          " does not show which axis points up: the body neither turned nor drove a curve: drive both "
          "ways round, and lines as well as turns",
      FloorProblem::no_up_axis, {track.name});
}

/// Projects positions onto a plane, and measures headings about its normal.
class Plane {
 public:
  explicit Plane(const Direction3& up) : up_(up[0], up[1], up[2]) {
    // The plane's x axis is the projection of the frame's x axis, so that y-up and z-up give the usual
    // frames; if x is nearly vertical, it is that of the y axis.
    const Eigen::Vector3d x = std::abs(up_[0]) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    ahead_ = (x - up_ * up_.dot(x)).normalized();
    left_ = up_.cross(ahead_);
  }

  FloorPoint at(const TrackedPose& sample, double start_s) const {
    const Eigen::Vector3d p(sample.pose.x_m, sample.pose.y_m, sample.pose.z_m);
    const Eigen::Vector3d q(sample.pose.qx, sample.pose.qy, sample.pose.qz);
    return {start_s, p.dot(ahead_), p.dot(left_), 2 * std::atan2(q.dot(up_), sample.pose.qw)};
  }

 private:
  Eigen::Vector3d up_, ahead_, left_;
};

/// The valid samples. Times count from the first sample, because a double has too few digits for an epoch
/// time.
std::vector<FloorPoint> points_of(const BodyTrack& track, const Direction3& up) {
  const Plane plane(up);
  const bool turns = track.facts.rotation_kind != RotationKind::none;
  std::vector<FloorPoint> points;
  points.reserve(track.samples.size());
  bool joined = true;
  for (const TrackedPose& sample : track.samples) {
    joined = joined && sample.valid;
    if (!sample.valid) continue;
    FloorPoint point =
        plane.at(sample, 1e-9 * static_cast<double>(sample.time_ns - track.samples[0].time_ns));
    if (!turns) point.theta_rad = std::numeric_limits<double>::quiet_NaN();
    if (turns && !points.empty()) {
      const double before = points.back().theta_rad;
      point.theta_rad = before + std::remainder(point.theta_rad - before, 2 * std::numbers::pi);
    }
    point.joined = joined;
    joined = true;
    points.push_back(point);
  }
  return points;
}

void scale(std::vector<FloorPoint>& points, double x_factor, double y_factor) {
  for (FloorPoint& point : points) {
    point.x_m *= x_factor;
    point.y_m *= y_factor;
  }
}

void reverse(std::vector<FloorPoint>& points, Direction3& up) {
  for (FloorPoint& point : points) {
    point.y_m = -point.y_m;
    point.theta_rad = -point.theta_rad;
  }
  for (double& component : up) component = -component;
}

bool has_headings(const std::vector<FloorPoint>& points) {
  return !points.empty() && !std::isnan(points.front().theta_rad);
}

/// Reflects the positions if the path turns against the orientation.
void settle_mirror(std::vector<FloorPoint>& points, const FloorChoices& choices, FloorFindings& findings) {
  constexpr double kSure = 0.3;
  findings.handedness = handedness(points);
  findings.mirrored = choices.mirrored.value_or(findings.handedness < -kSure);
  if (!findings.mirrored) return;
  scale(points, 1, -1);
  if (!choices.mirrored)
    findings.remarks.push_back(
        {"the path turns left where the orientation turns right: the positions are a mirror "
         "image and were reflected"});
}

void settle_units(std::vector<FloorPoint>& points, const BodyTrack& track,
                  std::span<const WheelMotion> wheels, const FloorChoices& choices, FloorFindings& findings) {
  constexpr double kShortest_m = 0.1, kSameUnit = 2.5;
  const double path_m = path_length(points);
  findings.wheels_path_m = path_length(wheels);
  if (findings.wheels_path_m > kShortest_m) findings.length_ratio = path_m / findings.wheels_path_m;
  for (const double ratio : {1000.0, 100.0, 0.01, 0.001}) {
    if (findings.length_ratio > ratio / kSameUnit && findings.length_ratio < ratio * kSameUnit)
      findings.unit_ratio = ratio;
  }
  const bool stated = !track.facts.length_unit.empty();
  findings.length_factor = choices.length_factor.value_or(stated ? 1 : 1 / findings.unit_ratio);
  scale(points, findings.length_factor, findings.length_factor);
  findings.path_m = path_length(points);
  if (findings.unit_ratio != 1 && !choices.length_factor)
    findings.remarks.push_back(
        {fmt::format("the path is {:.4g} times as long as that of the wheels, so one of the two "
                     "has another unit of length than it seems{}",
                     findings.length_ratio,
                     stated ? "" : "; the file states none, and its positions were converted"),
         FloorRemark::units_differ,
         {fmt::format("{:.4g}", findings.length_ratio)}});
}

/// Whether the track turns as the wheels do: by its headings, or by where the path lies if there are none.
double agreement_with(const std::vector<FloorPoint>& points, std::span<const WheelMotion> wheels,
                      const Turning& by_wheels, const ClockMatch& clock) {
  if (!has_headings(points)) return handedness(points, wheels, clock);
  return turning_correlation(heading_turning(points), by_wheels, clock.offset_s, clock.skew, clock.middle_s);
}

/// From the rightmost to the leftmost heading.
double turned(const Turning& turning) {
  double least = 0, most = 0;
  for (const TurningSample& sample : turning) {
    least = std::min(least, sample.angle_rad);
    most = std::max(most, sample.angle_rad);
  }
  return most - least;
}

/// Compares with the wheels: the clocks, and left against right.
void settle_direction(std::vector<FloorPoint>& points, std::span<const WheelMotion> wheels,
                      FloorFindings& findings) {
  constexpr double kSure = 0.3, kLeastTurn_rad = 0.15;  // less is how a robot sways about a line
  // With a wrong unit the speeds would outweigh the turn rates.
  const double to_metres = findings.length_factor == 1 ? 1 / findings.unit_ratio : 1;
  findings.clock = match_clocks(points, to_metres, wheels);
  if (!findings.clock) {
    findings.remarks.push_back(
        {"the motion is not that of the wheels, so left and right could not be checked: check that both were "
         "recorded together"});
    return;
  }
  const Turning by_wheels = turning_of(wheels);
  findings.turning_correlation = agreement_with(points, wheels, by_wheels, *findings.clock);
  if (findings.turning_correlation > -kSure || turned(by_wheels) < kLeastTurn_rad) return;
  findings.turns_against_wheels = true;
  if (findings.up_given) {
    findings.remarks.push_back(
        {"the body turns left where the wheels turn right, with the up axis as it was given"});
    return;
  }
  reverse(points, findings.up);
  findings.reversed = true;
  findings.turning_correlation = -findings.turning_correlation;
}

double mean_height(const BodyTrack& track, const Direction3& up) {
  double sum = 0, count = 0;
  for (const TrackedPose& sample : track.samples) {
    if (!sample.valid) continue;
    sum += sample.pose.x_m * up[0] + sample.pose.y_m * up[1] + sample.pose.z_m * up[2];
    ++count;
  }
  return sum / count;
}

std::vector<recording::TruthSample> samples_of(const BodyTrack& track,
                                               const std::vector<FloorPoint>& points) {
  std::vector<recording::TruthSample> out;
  out.reserve(track.samples.size());
  std::size_t next = 0;
  for (const TrackedPose& sample : track.samples) {
    recording::TruthSample one;
    one.time_us = whole_microseconds(sample.time_ns);
    one.valid = sample.valid;
    const FloorPoint& point = points[std::min(next, points.size() - 1)];
    one.x_m = point.x_m;
    one.y_m = point.y_m;
    one.theta_rad = point.theta_rad;
    next += sample.valid;
    out.push_back(one);
  }
  return out;
}

}  // namespace

FloorPath place_on_floor(const BodyTrack& track, std::span<const WheelMotion> wheels,
                         const FloorChoices& choices) {
  if (track.samples.size() == 2) wheels = {};  // the two ends of a drive show nothing of the way between them
  FloorPath out;
  FloorFindings& findings = out.findings;
  findings.up = known_up(track, choices, findings);
  std::vector<FloorPoint> points = points_of(track, findings.up);
  if (points.empty())
    throw Error("'" + track.name + "' has no valid pose", FloorProblem::no_valid_pose, {track.name});
  settle_mirror(points, choices, findings);
  settle_units(points, track, wheels, choices, findings);
  if (!wheels.empty()) settle_direction(points, wheels, findings);
  findings.height_m = mean_height(track, findings.up) * findings.length_factor;
  findings.turned_rad = points.back().theta_rad - points.front().theta_rad;
  out.samples = samples_of(track, points);
  return out;
}

}  // namespace astro::truth
