#pragma once

#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/body_track.hpp"

/// What Vicon Tracker, Nexus and Shogun export as CSV.
///
/// Layout    sections that end with a blank line: title, rate, names (each above the first of its columns), axes,
///           units, data. Bodies are in the sections Objects, Segments and Joints; the others are passed over.
/// Rotation  a quaternion, or three numbers that are a rotation vector (Tracker's default, "helical") or Euler angles XYZ;
///           the header does not say which. A robot does not tilt, so the reading with the smaller tilt is taken, and
///           facts.rotation says so. Rotation vectors may be longer than half a turn.
/// Times     (frame - first frame) / rate. tables::Rows with a sub-frame are passed over.
/// Lost      empty cells, or a row that ends early.
namespace astro::truth {

/// The bodies of all sections. Throws astro::Error if there is none.
std::vector<BodyName> bodies_in_vicon(std::string_view text, std::string_view file);

/// The track of one body, by its name "subject:segment", or by the subject alone where that is enough.
/// Throws astro::Error with file, line and column.
BodyTrack read_vicon(std::string_view text, std::string_view file, std::string_view body = {});

}  // namespace astro::truth
