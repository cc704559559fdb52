#pragma once

#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"

/// A table whose first row names the columns.
///
/// Bodies    a body's name is what its columns' names begin with: /mocap/pose/position/x belongs to "/mocap", robot_x_m to
///           "robot", x_m to "". A body without its own time uses the first one of the table.
/// Position  x, y and perhaps z: x_m, "x (mm)", "x [cm]", tx, position.x, /pose/position/x
/// Rotation  qx, qy, qz, qw (also orientation.x ...), or theta, yaw or heading about z; without either the
///           track has positions only
/// Time      time_s, time_ms, time_us, time_ns, t, stamp, timestamp, __time
/// Units     behind an underscore or in brackets. Without one: metres, radians, and for the time the unit that
///           makes an epoch time of large numbers, else seconds. facts.remarks names each unit that was assumed.
///
/// Cells are separated by commas, semicolons (then with decimal points or commas), tabs or blanks. Columns with other names
/// are ignored.
namespace astro::truth {

/// The bodies that have a time and a position. Throws astro::Error if there is none.
std::vector<BodyName> bodies_in_plain(std::string_view text, std::string_view file);

/// The track of one body (choose_body). Throws astro::Error with file, line and column.
BodyTrack read_plain(std::string_view text, std::string_view file, std::string_view body = {});

/// Whether a header such as this has a time and a position.
bool is_plain_header(std::string_view line);

}  // namespace astro::truth
