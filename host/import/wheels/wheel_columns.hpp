#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/formats/tables/table.hpp"
#include "host/formats/tables/time_column.hpp"
#include "host/import/wheels/wheel_track.hpp"

namespace astro::importing {

/// Which columns of a table hold the time and the wheels, and in which units.
struct WheelColumns {
  tables::TimeColumns time;
  std::vector<std::size_t> left, right;  // one of each, or those of a robot with several wheels on a side
  WheelUnit unit = WheelUnit::counts;
  double scale = 1;           // of a value to radians, metres or counts, or these in a second
  std::string unit_text;      // as above the columns, "" if it is not stated
  bool per_interval = false;  // each row is the travel since the row before
  bool speeds = false;        // each row is the speed at its time
  std::vector<Remark> remarks;
};

/// The columns with these names, which are of `table` or were stated about it.
///
/// Sides       left, right, l, r; words with them (leftWheel, wl, encR); FL, FR, RL, RR and front and rear for four wheels;
///             links and rechts and the words of other languages (joint_names.hpp)
/// Quantities  by the unit (host/formats/tables/units.hpp): counts, angles, travel, or speeds, if there is none of these;
///             "delta", "per_interval": travel per interval, and "d" where it ends as it begins and goes up and down by turns.
///             Encoders without a unit count; other names without one are counts if all cells are whole numbers.
/// Left out    what was commanded (cmd, target, ...), and currents, voltages and the like.
///
/// Errors  UnclearChoice (unclear_choice.hpp) with all names, in a sentence that says what is missing, or which column could
///         be what.
WheelColumns wheel_columns(const std::vector<std::string>& names, tables::Table& table);

}  // namespace astro::importing
