#pragma once

#include <filesystem>

#include "host/report/sections/film_report.hpp"
#include "host/truth/film/track/film_track.hpp"

namespace astro::commands {

/// The report on a film: what `film_text` says, the preview, and plots of the path, of what remains of the corners and of the
/// camera's motion.
report::FilmReportInput film_page(const std::filesystem::path& film, const film::FilmTrack& track,
                                  std::vector<std::uint8_t> preview_png);

}  // namespace astro::commands
