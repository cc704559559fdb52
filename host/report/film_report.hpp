#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/report/report.hpp"
#include "host/report/svg_plot.hpp"

namespace astro::report {

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
