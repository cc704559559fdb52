#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/truth/source/pose3.hpp"

/// Ground truth as a tracker recorded it: the poses of one body in space.
namespace astro::truth {

/// A pose at a time. If it is not valid, the tracker had lost the body and the pose means nothing.
struct TrackedPose {
  std::int64_t time_ns = 0;
  Pose3 pose;
  bool valid = true;
};

enum class FileKind : std::uint8_t {
  unknown,
  motive,       // OptiTrack Motive, a table with a column for each value
  motive_rows,  // Motive before 1.7, a word at the head of each row; not read
  vicon,        // Vicon Tracker, Nexus or Shogun
  qualisys,     // Qualisys Track Manager, TSV
  tum,          // seconds, position, quaternion with w last
  euroc,        // nanoseconds, position, quaternion with w first
  plain,        // names with units in the first row
};

enum class RotationKind : std::uint8_t {
  none,  // positions only: the quaternions of the poses mean nothing
  quaternion,
  euler,
  rotation_vector,
  heading,  // one angle about z
};

/// What looks odd in a recording. The value is the number of rows, the unit of time, the greatest difference in milliseconds, the
/// seconds after which the times start again, or for times_spread how many rows each time has and how many seconds the times are apart.
enum class TrackRemark {
  length_unit_assumed,
  heading_unit_assumed,
  headings_clockwise,
  time_unit_assumed,
  times_repeated,
  times_continued,
  times_spread,
  times_disagree,
  ends_without_times
};

/// What the recording says of itself, as found; the poses are already converted.
struct TrackFacts {
  FileKind kind = FileKind::unknown;
  std::string format;       // "Motive CSV 1.23"
  double rate_hz = 0;       // 0: not stated
  std::string length_unit;  // "Meters", "mm"; "" if the file states none, and metres are assumed
  bool flat = false;        // positions on the floor, without heights
  RotationKind rotation_kind = RotationKind::none;
  std::string rotation;    // "Euler angles YXZ in degrees"
  std::string start_time;  // "2020-12-23T01:18:10.123", local, of a zone that no file names; "" if not stated
  bool start_time_sure = true;      // false: on a twelve-hour clock without morning or afternoon
  std::int64_t dropped_frames = 0;  // missing in the frame numbers
  std::vector<Remark> remarks;      // what looks odd in the file: TrackRemark
};

/// Axes      as in the file: which one points up is stated by no format (host/truth/floor finds it).
/// Units     metres, nanoseconds. Quaternions have length 1 where the sample is valid.
/// Times     of the recording's own clock, increasing. Frames that were not recorded are missing.
struct BodyTrack {
  std::string name, id;  // as the tracker calls the body; "" if the file does not name it
  std::vector<TrackedPose> samples;
  TrackFacts facts;
};

}  // namespace astro::truth
