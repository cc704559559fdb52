#include "host/commands/shared/film_truth.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/wrong_usage.hpp"

namespace astro::commands {
namespace {

constexpr Advice kFilmTruthAdvice[] = {
    {film::FilmedRunProblem::no_odometry,
     ": leave it out (of a folder: 'astrolabe calibrate runs --without {0}')"},
};

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "film:";

void say_report(const film::FilmReport& report) {
  for (const auto& run : report.runs)
    console::say(fmt::format("{}: {:.2f} to {:.2f} s of '{}' (turning and driving agree by {:.3f})", run.run,
                             run.from_s, run.to_s, run.film, run.place.likeness.visible));
  if (report.readout_sigma_s)
    console::say(fmt::format("the camera reads a picture in {:.1f} ± {:.1f} ms{}, as the odometry shows",
                             1e3 * std::abs(report.readout_s), 1e3 * *report.readout_sigma_s,
                             report.readout_s < 0 ? ", from its last row to its first" : ""));
  for (const Remark& remark : report.remarks) console::say(in_words(remark));
}

}  // namespace

std::optional<fs::path> film_named(const std::string& word) {
  if (!word.starts_with(kPrefix) || word.size() == kPrefix.size()) return std::nullopt;
  return fs::path(word.substr(kPrefix.size()));
}

void add_film_truth(console::Command command, FilmTruthOption& option) {
  advise(kFilmTruthAdvice);
  command
      .add_option("--truth", option.films,
                  "film:FILE takes the ground truth from a phone film of\nprinted tags (repeatable) in place "
                  "of the recorded "
                  "one")
      .type_name("film:FILE")
      .check([](const std::string& word) -> std::string {
        return film_named(word) ? "" : "'" + word + "' is no film: write film:FILE";
      })
      .one_each_time();
  add_film_options(command, option.figures, "film: ");
}

std::vector<film::NamedFilm> follow_films(const std::vector<fs::path>& films, const FilmOptions& figures) {
  std::vector<film::NamedFilm> all;
  for (const fs::path& path : films) {
    console::Progress progress("looking at '" + path.filename().string() + "'");
    film::FilmTrack track = film::follow_film(path, figures_of(figures), [&](double done) {
      console::check_interrupt();
      progress.show(done);
    });
    progress.clear();
    console::say(fmt::format(
        "'{}': the robot's tag in {} of {} pictures, {} floor tags, corners to {:.2f} px, scale {}",
        path.filename().string(), track.found.poses.size(), track.sightings.pictures, track.floor.size(),
        track.found.corner_px,
        track.figures.scale_measured() ? fmt::format("to {:.2g} %", 100 * track.scale_sigma) : "not found"));
    for (const Remark& remark : track.remarks)
      console::say("'" + path.filename().string() + "': " + in_words(remark));
    all.push_back({path.filename().string(), std::move(track)});
  }
  return all;
}

void give_truth(experiment::RunSet& set, const std::vector<film::NamedFilm>& films,
                const FilmOptions& figures) {
  const std::optional<double> readout_s =
      figures.readout_ms ? std::optional(1e-3 * *figures.readout_ms) : std::nullopt;
  say_report(film::attach_films(set, films, readout_s));
  for (recording::Run& run : set.runs) run.scans.clear();  // who names a film does not mean the scanner
}

void require_film_for(const FilmOptions& figures, bool film) {
  if (!film && figures.given())
    throw console::WrongUsage(
        "--robot-tag, --tag-side, --tag-height, --floor-tag-side, --tape and --readout go with --truth "
        "film:FILE");
}

void give_truth(experiment::RunSet& set, const FilmTruthOption& option) {
  require_film_for(option.figures, !option.films.empty());
  if (option.films.empty()) return;
  std::vector<fs::path> films;
  for (const std::string& word : option.films) films.push_back(film_named(word).value());
  give_truth(set, follow_films(films, option.figures), option.figures);
}

}  // namespace astro::commands
