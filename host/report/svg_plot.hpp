#pragma once

#include <string>
#include <vector>

namespace astro::report {

/// A line of a plot, or points.
struct PlotLine {
  std::vector<double> x, y;  // NaN: the line is broken there
  bool points = false;
  std::vector<std::string> labels = {};  // beside the points; may be empty
};

struct Plot {
  std::string caption, x_name, y_name;
  std::vector<PlotLine> lines;
  bool equal_axes = false;  // one unit is equally long on both axes
};

/// A figure that needs no script: SVG inside <figure>, with a frame, round numbers at the axes, and each line in a colour of its
/// own. At most about 3000 points of each line are drawn. Texts are escaped. "" if there is nothing finite to show.
std::string svg_figure(const Plot& plot);

}  // namespace astro::report
