#pragma once

#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"

/// A table whose columns have names, in its first row or from outside.
///
/// Bodies    a body's name is what its columns' names begin with: /mocap/pose/position/x belongs to "/mocap", robot_x_m to
///           "robot", x_m to "". A body without its own time uses the first one of the table. In a table with a column of
///           numbers of tags or markers ("tag_id"), each number is a body, if there are several.
/// Position  x, y and perhaps z: x_m, "x (mm)", "x [cm]", tx, posX, x_pos, position.x, /pose/position/x
/// Rotation  qx, qy, qz, qw (also orientation.x ...); roll, pitch and yaw (about z, then y, then x); or theta, yaw or heading
///           about z; without any of them the track has positions only
/// Time      time_s, time_ms, t, stamp, timestamp, __time; sec and nanosec; dates and times of day (host/formats/tables). Not
///           in a table of two rows, which are then the ends of a drive.
/// Units     behind an underscore or in brackets, or in a line of their own. Without one: metres; for angles
///           that which the direction of motion shows, else radians; for the time that which its size or spacing shows.
///           facts.remarks names each unit that was assumed.
///
/// Separators, decimal commas, comments: host/formats/tables/table.hpp. Columns with other names are ignored.
namespace astro::truth {

/// What is known of a table besides its content.
struct PlainTable {
  std::string_view text, file;
  std::string_view columns =
      {};  // names of the columns from outside (stated_columns.hpp); "": those in the text
};

/// The bodies that have a time and a position. Throws astro::Error if there is none.
std::vector<BodyName> bodies_in_plain(const PlainTable& table);

/// The track of one body (choose_body). Throws astro::Error with file, line and column.
BodyTrack read_plain(const PlainTable& table, std::string_view body = {});

/// Whether the columns of a text have the names of a time and a position.
bool is_plain(std::string_view text);

}  // namespace astro::truth
