#pragma once

#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"

/// What OptiTrack Motive exports as tracking data, format versions 1.2 to 1.25.
///
/// Layout  one line of keys and values; rows of types, names and ids of the columns, from 1.22 on with a label,
///         in 1.25 with one row more; a row of Rotation and Position; the row that begins with Frame; data. The
///         rows are found by their content, because their number differs between versions.
/// Times   frame number / export rate. The column of times is rounded to 1 ms in some versions, so it is only
///         compared. A missing frame number is a frame that the file does not have.
/// Lost    empty cells.
/// Axes    right-handed, y up unless another convention was chosen for the export, which the file does not say.
///
/// Files that a spreadsheet has saved again can be read: with a byte order mark, trailing commas, or
/// semicolons and decimal commas.
namespace astro::truth {

/// The rigid bodies in the file. Throws astro::Error if it has none or its header is missing.
std::vector<BodyName> bodies_in_motive(std::string_view text, std::string_view file);

/// The track of one rigid body (choose_body). Throws astro::Error with file, line and column.
BodyTrack read_motive(std::string_view text, std::string_view file, std::string_view body = {});

/// "2020-12-23 01.18.10.123 PM" as "2020-12-23T13:18:10.123"; "" if it is no time. `sure` becomes false if
/// the clock has twelve hours and no known word says morning or afternoon.
std::string motive_start_time(std::string_view text, bool& sure);

}  // namespace astro::truth
