#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/truth/files/body_choice.hpp"
#include "host/truth/files/pose_columns.hpp"

/// The sections of a Vicon export and the columns of their bodies: what vicon_csv.hpp needs to read the rows.
namespace astro::truth {

/// A body and where its numbers are.
struct ViconBody {
  BodyName name;
  PoseColumns columns;
  double rate_hz = 0;
  std::string length_unit, angle_unit;
  int section_line = 0;  // of the section's title
};

/// Whether a section of a Vicon export can have this title.
bool is_vicon_title(std::string_view cell);

/// All bodies in the file; a body in several sections is taken from the first. Throws astro::Error if there is
/// none, or if a section has another form.
std::vector<ViconBody> find_vicon_bodies(std::string_view text, std::string_view file);

}  // namespace astro::truth
