#pragma once

#include <string>
#include <vector>

#include "host/truth/tags/tag_sheet.hpp"
#include "host/truth/tags/text_sheet.hpp"

/// What a person reads on the sheets of `astrolabe tags`: how a film is made that a calibration can use.
namespace astro::commands {

/// The page that comes before the tags.
truth::tags::TextSheet tags_instructions(int robot_id, double robot_side_mm, double floor_side_mm);

/// Three lines below a tag: how the scale is checked and how the sheet is fixed.
std::vector<std::string> notes_below_tag(truth::tags::TagRole role);

}  // namespace astro::commands
