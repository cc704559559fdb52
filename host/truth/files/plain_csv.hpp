#pragma once

#include <string_view>

#include "host/truth/files/body_track.hpp"

/// A table of one body whose first row names the columns.
///
/// Position  x, y and perhaps z: x_m, "x (mm)", "x [cm]", tx, position.x, /pose/position/x
/// Rotation  qx, qy, qz, qw (also orientation.x ...), or theta, yaw or heading about z; without either the
///           track has positions only
/// Time      time_s, time_ms, time_us, time_ns, t, stamp, timestamp, __time
/// Units     behind an underscore or in brackets. Without one: metres, radians, and for the time the unit that
///           makes an epoch time of large numbers, else seconds. facts.remarks names each unit that was assumed.
///
/// Cells are apart by commas, semicolons (then with decimal points or commas), tabs or blanks. Columns of other
/// names are passed over.
namespace astro::truth {

/// Throws astro::Error with file, line and column.
BodyTrack read_plain(std::string_view text, std::string_view file);

/// Whether a header such as this has a time and a position.
bool is_plain_header(std::string_view line);

}  // namespace astro::truth
