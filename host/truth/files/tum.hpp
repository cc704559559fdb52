#pragma once

#include <string_view>

#include "host/truth/files/body_track.hpp"

/// Trajectories of one body as the benchmarks TUM RGB-D and EuRoC write them.
///
/// TUM    seconds x y z qx qy qz qw, separated by blanks, tabs or commas; lines that begin with # are
///        comments.
/// EuRoC  nanoseconds,x,y,z,qw,qx,qy,qz and perhaps more, separated by commas. It is recognised by its first
///        row: the time is a whole number of at least 15 digits.
///
/// Times are exact to the nanosecond. Metres.
namespace astro::truth {

/// Throws astro::Error with file, line and column.
BodyTrack read_tum(std::string_view text, std::string_view file);

/// Whether a row of this text can be one of TUM (8 numbers) or of EuRoC; FileKind::unknown otherwise.
FileKind tum_kind_of(std::string_view line);

}  // namespace astro::truth
