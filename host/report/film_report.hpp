#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/report/report.hpp"

namespace astro::report {

/// A line of a plot, or points.
struct PlotLine {
  std::vector<double> x, y;  // NaN: the line is broken there
  bool points = false;
  std::vector<std::string> labels = {};  // beside the points; may be empty
};

/// A figure of lines and points that needs no script.
struct Plot {
  std::string caption, x_name, y_name;
  std::vector<PlotLine> lines;
  bool equal_axes = false;  // one unit is equally long on both axes
};

/// What a film of printed tags shows: one HTML file of the same template as the others.
struct FilmReportInput {
  std::string title;
  std::vector<DescriptionRow> description;
  std::vector<std::string> remarks;
  std::vector<std::uint8_t> preview_png;
  std::vector<Plot> plots;
};

/// Equal inputs give equal bytes; every text of the input is escaped. Size: four thirds of the picture's, and the plotting
/// library of the template.
std::string render_film_html(const FilmReportInput& input);

}  // namespace astro::report
