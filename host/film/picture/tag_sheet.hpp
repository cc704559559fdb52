#pragma once

#include <string>
#include <vector>

#include "host/film/picture/canvas.hpp"

namespace astro::film::paper {

enum class TagRole { robot, floor };

/// One tag on a sheet of paper. An arrow at the sheet's top shows where the tag's x axis (robot) or its top (floor) points.
/// The black square's centre has a grey cross, to measure from, and below it are a ruler and the notes.
struct TagSheet {
  TagRole role = TagRole::floor;
  int id = 0;
  double side_mm = 160;  // of the black square
  std::vector<std::string> notes;
};

/// The largest side whose white margin and ruler fit on the paper, rounded down to a millimetre.
double largest_side_mm(const Paper& paper);

/// The centre of the black square.
Place tag_centre(const TagSheet& sheet, const Paper& paper);

/// Throws astro::Error if there is no such tag, if it does not fit on the paper, or if its side is below 10 mm.
void draw(Canvas& canvas, const TagSheet& sheet, const Paper& paper);

}  // namespace astro::film::paper
