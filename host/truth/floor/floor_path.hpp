#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/recording/run.hpp"
#include "host/truth/files/body_track.hpp"
#include "host/truth/floor/up_axis.hpp"
#include "host/truth/floor/wheel_match.hpp"

/// Converts a track in space to the robot's path on the floor. What a recording does not state is inferred from the motion,
/// reported, and can be overridden.
namespace astro::truth {

/// Why a track cannot be placed on the floor. The first value is its name; of frames_differ the normal of the
/// positions, the axis of the rotations and the degrees between them follow.
enum class FloorProblem { no_valid_pose, frames_differ, no_up_axis };

/// What looks odd in a track. The value is the length of its path over that of the wheels.
enum class FloorRemark { units_differ };

/// What a person states. What has no value is inferred.
struct FloorChoices {
  std::optional<Direction3> up;         // in the file's axes; need not have length 1
  std::optional<double> length_factor;  // metres for each metre of the track
  std::optional<bool> mirrored;         // positions are reflected against the orientations
};

struct FloorFindings {
  UpAxisEvidence evidence;
  Direction3 up{0, 0, 1};  // the axis that was used
  bool up_given = false;

  /// The wheels turn the other way, so the axis was reversed: the frame's z axis points down, or the whole
  /// recording is a mirror image, which is the same on the floor.
  bool reversed = false;

  /// The body turns against the wheels about the axis that was fitted or given. If it was fitted, it was then reversed.
  bool turns_against_wheels = false;

  /// Mean height of the body above the tracker's origin along the axis that was used: the origin is on the floor as a
  /// rule.
  double height_m = 0;

  /// The path turns left where the orientation turns right: one of the two is a mirror image, so the positions
  /// were reflected.
  bool mirrored = false;
  double handedness = 0;  // the measure of that, before the reflection (wheel_match.hpp)

  double path_m = 0;
  double turned_rad = 0;  // from the first to the last valid sample; NaN without headings

  /// Only with wheels.
  std::optional<ClockMatch> clock;
  double wheels_path_m = 0;
  double turning_correlation =
      0;  // of the returned path's turning with the wheels'; without headings its handedness
  double length_ratio = 0;  // path of the track over path of the wheels, before any factor; 0: not known
  /// 1000, 100, 0.01 or 0.001 if the ratio is near it, else 1: one of the two has a wrong unit of length.
  double unit_ratio = 1;
  double length_factor = 1;  // by which the positions were multiplied

  std::vector<Remark> remarks;  // each as a sentence
};

struct FloorPath {
  /// The frame is right-handed, and its z axis points up. theta is continuous; NaN if the track has no rotations. Times are
  /// microseconds of the recording's own clock.
  std::vector<recording::TruthSample> samples;
  FloorFindings findings;
};

/// Places a track on the floor. The heading is the turn about the up axis that remains without the tilt, so that tilt and the
/// sign of a quaternion change nothing.
///
/// Units    a ratio near 1000, 100, 0.01 or 0.001 between the paths is corrected where the file states no unit;
///          where it states one, it is only reported, because the wheels may be wrong as well.
///
/// Errors   astro::Error if positions and orientations are in different frames, or if the motion does not show
///          which axis is up and `choices.up` does not say it.
/// Cost     below 1 s for an hour at 100 Hz.
FloorPath place_on_floor(const BodyTrack& track, std::span<const WheelMotion> wheels = {},
                         const FloorChoices& choices = {});

}  // namespace astro::truth
