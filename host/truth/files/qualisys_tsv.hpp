#pragma once

#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"

/// Exports of Qualisys Track Manager as TSV, with their header: bodies (6D) or markers (3D).
///
/// A row may begin with the frame number and the time; times are frame numbers over FREQUENCY. A body has X, Y, Z in mm, three
/// angles, the residual and the rotation matrix by columns, which is used, because the angles' meaning is a setting of the
/// program. A body or a marker whose position is all zero, or whose residual is negative, was lost.
/// Source  QTM user manual, "TSV file formats".
namespace astro::truth {

bool is_qualisys(std::string_view text);

/// Throw astro::Error with file, line and column, if the header has no frequency, no names, or another number of columns.
std::vector<BodyName> bodies_in_qualisys(std::string_view text, std::string_view file);
BodyTrack read_qualisys(std::string_view text, std::string_view file, std::string_view body = {});

}  // namespace astro::truth
