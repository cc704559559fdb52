#pragma once

#include <string>
#include <vector>

#include "host/film/picture/canvas.hpp"

namespace astro::film::paper {

/// A paragraph of instructions: a heading in bold, and its text, which is broken into lines at blanks. A line break in the text
/// begins a new line, and one that begins with a blank is indented. Without a heading it goes on below the one before.
struct Paragraph {
  std::string heading, text;
};

struct TextSheet {
  std::string title;
  std::vector<Paragraph> paragraphs;
};

/// Returns where the text ends, in millimetres from the top. The caller checks that this is on the paper.
double draw(Canvas& canvas, const TextSheet& sheet, const Paper& paper);

}  // namespace astro::film::paper
