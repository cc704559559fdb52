#include "host/commands/truth/truth_film.hpp"

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/film_options.hpp"
#include "host/commands/truth/film_page.hpp"
#include "host/commands/truth/truth_film_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/report/page/page.hpp"
#include "host/truth/film/preview/preview.hpp"
#include "host/truth/film/track/film_checks.hpp"

namespace astro::commands {
namespace {

namespace fs = std::filesystem;

struct TruthFilmOptions {
  fs::path film, preview, page, csv, tum;
  FilmOptions figures;
  bool json = false;
};

void save(const fs::path& path, ByteView bytes) {
  PartFile file(path);
  file.write(bytes);
  file.commit();
  console::say("written to " + path.string());
}

/// Before minutes of work, not after them.
void require_different(const std::vector<fs::path>& outputs) {
  std::set<fs::path> seen;
  for (const fs::path& path : outputs)
    if (!path.empty() && !seen.insert(fs::absolute(path).lexically_normal()).second)
      throw Error("'" + path.string() + "' would be written twice", {Help::name_other_file});
}

void run(const TruthFilmOptions& options) {
  for (const fs::path& out : {options.preview, options.page, options.csv, options.tum})
    require_no_input(out, {options.film});
  require_different({options.preview, options.page, options.csv, options.tum});
  if (!options.page.empty()) report::require_replaceable(options.page);
  console::Progress progress("looking at the film");
  const film::FilmTrack track =
      film::follow_film(options.film, figures_of(options.figures), [&](double done) {
        console::check_interrupt();
        progress.show(done);
      });
  progress.clear();
  if (!options.csv.empty()) save(options.csv, as_bytes(film_csv(track.found)));
  if (!options.tum.empty()) save(options.tum, as_bytes(film_tum(track.found, track.scene.robot_height_m)));
  std::vector<std::uint8_t> picture;
  if (!options.preview.empty() || !options.page.empty()) picture = film::preview_png(options.film, track);
  if (!options.preview.empty()) save(options.preview, picture);
  if (!options.page.empty()) {
    report::write_page(options.page,
                       report::render_film_html(film_page(options.film, track, std::move(picture))));
    console::say("written to " + options.page.string());
  }
  if (options.json)
    print_json(to_json(track));
  else
    write(film_text(track));
  // All the same it is printed, so that a person sees where that was.
  if (const std::optional<Remark> gone = film::departure(options.film, track)) throw Error(*gone);
}

}  // namespace

void add_truth_film(console::Command truth) {
  const auto options = std::make_shared<TruthFilmOptions>();
  const console::Command command =
      truth.add_subcommand("film", "what a phone film of printed tags shows: tags, camera, path and errors");
  command.add_option("film", options->film, "the film, as the phone wrote it (MP4 or MOV)")
      .type_name("FILE")
      .required();
  add_film_options(command, options->figures);
  command.add_option("--preview", options->preview, "write a picture with what was found drawn into it")
      .type_name("FILE.png");
  command.add_option("--report", options->page, "write a page with plots").type_name("FILE.html");
  command.add_option("--csv", options->csv, "write the poses as a table").type_name("FILE");
  command.add_option("--tum", options->tum, "write the poses as TUM (time x y z qx qy qz qw)")
      .type_name("FILE");
  add_json_flag(command, options->json);
  command.footer(
      "Lay a printed tag on the robot (id 0) and four to six on the floor around the field, flat. Put the "
      "phone on a\n"
      "shelf or tripod, 2 m high or higher, looking down by 35 degrees or more; 1080p, stabilisation off, "
      "exposure and\n"
      "focus locked. Film everything in one go. Measure the height of the robot's tag, the sides of the "
      "black squares\n"
      "and the distance of two floor tags; without a distance all is found but the scale.\n"
      "Poses are those of the robot's tag in the frame of the floor tag with the lowest number, at the times "
      "at which\n"
      "its rows were read.\n"
      "Examples:\n"
      "  astrolabe truth film drives.mp4 --tag-height 121mm --preview preview.png\n"
      "  astrolabe truth film drives.mp4 --tag-side 120.1mm --tag-height 121mm --floor-tag-side 160mm \\\n"
      "    --tape 1:4=3.46m --report film.html --csv poses.csv");
  command.callback([options] { run(*options); });
}

}  // namespace astro::commands
