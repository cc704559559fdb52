#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "host/base/error.hpp"
#include "host/import/wheels/joint_names.hpp"

/// Travel of any robot's wheels as it was recorded, before any geometry is applied.
namespace astro::importing {

/// What was inferred about wheels, or is odd about them. Values: the first column (counts_assumed, per_interval_assumed), the
/// unit (time_unit_assumed), the part of the travel in percent that the sampling leaves uncertain (speeds_integrated), the side
/// and by how many percent its wheels differ in travel (sides_differ), the side and the range (continued), the file and the time
/// in seconds (first_left_out, restart_joined).
enum class WheelRemark {
  counts_assumed,
  per_interval_assumed,
  time_unit_assumed,
  speeds_integrated,
  sides_differ,
  continued,
  first_left_out,
  restart_joined
};

enum class WheelUnit : std::uint8_t { counts, radians, metres };

/// "counts", "rad" or "m".
constexpr const char* unit_name(WheelUnit unit) {
  return unit == WheelUnit::counts ? "counts" : unit == WheelUnit::radians ? "rad" : "m";
}

/// Travel since some start, forward positive. Counts are whole numbers up to 2^53 unless the file has
/// fractions.
struct WheelSample {
  std::int64_t time_ns = 0;
  double left = 0, right = 0;

  bool operator==(const WheelSample&) const = default;
};

enum class WheelClock : std::uint8_t {
  file,     // the time column of a table
  stamp,    // header.stamp: the clock of the robot's driver
  receipt,  // when the recorder received it, because the messages have no stamp
};

/// What was read from a table, by the names in its header ("column 3" without one).
struct ReadColumns {
  std::string time;
  std::vector<std::string> left, right;
  std::string values;  // what the cells are: "counts", "rpm", "m, travel per row"
};

/// Times increase strictly; travel is continuous and cumulative.
struct WheelTrack {
  WheelUnit unit = WheelUnit::counts;
  WheelClock clock = WheelClock::file;
  std::vector<WheelSample> samples;
  std::vector<Remark> remarks;          // what was inferred or left out
  ReadColumns columns;                  // of a table
  JointPair joints;                     // of a bag: those of the wheels
  std::optional<double> counter_range;  // at whose end a wheel started again; of counts only
  std::string odometry;  // of a bag: the topic from whose poses the wheels were worked out, otherwise ""
};

}  // namespace astro::importing
