#pragma once

#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"

/// Recordings of trackers as text, whatever program wrote them. The format is recognised by the content; file
/// names do not matter.
namespace astro::truth {

/// The format of a text by its first lines; FileKind::unknown if it is none that can be read.
FileKind recognise(std::string_view text);

/// The bodies in a recording. Formats of a single body without a name give one with an empty name. `columns`: the names of a
/// plain table's columns from outside (host/formats/tables/stated_columns.hpp), which make it one whatever it looks like.
/// Throws astro::Error with the reason of the format's reader, or if the format is unknown.
std::vector<BodyName> bodies_in(std::string_view text, std::string_view file, std::string_view columns = {});

/// The track of a body; `body` may be empty if there is only one. Samples are marked as invalid only where the
/// file says so; host/truth/floor/lost_tracking.hpp finds the others.
///
/// Cost    about 10 ns for each byte; 72 bytes of memory for each row.
/// Errors  astro::Error naming file, line and column; UnknownBody with the list of bodies.
BodyTrack read_track(std::string_view text, std::string_view file, std::string_view body = {},
                     std::string_view columns = {});

}  // namespace astro::truth
