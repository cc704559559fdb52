#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "host/base/bytes.hpp"
#include "host/base/error.hpp"
#include "host/base/files.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/film_options.hpp"
#include "host/commands/truth/commands.hpp"
#include "host/commands/truth/truth_film_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/film/runs/preview.hpp"
#include "host/film/track/film_checks.hpp"
#include "host/film/track/film_track.hpp"
#include "host/report/film_report.hpp"
#include "host/report/page.hpp"

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

/// To be called before minutes of work, not after them.
void require_different(const std::vector<fs::path>& outputs) {
  std::set<fs::path> seen;
  for (const fs::path& path : outputs)
    if (!path.empty() && !seen.insert(fs::absolute(path).lexically_normal()).second)
      throw Error("'" + path.string() + "' would be written twice: name another file");
}

constexpr double kGap_s = 0.5, kNothing = std::numeric_limits<double>::quiet_NaN();

/// The line is broken where the tag was hidden.
template <class X, class Y>
report::PlotLine pose_line(const std::vector<film::FilmPose>& poses, const X& x, const Y& y) {
  report::PlotLine line;
  double last_s = poses.empty() ? 0 : poses.front().time_s;
  for (const film::FilmPose& pose : poses) {
    if (pose.time_s - last_s > kGap_s) line.x.push_back(kNothing), line.y.push_back(kNothing);
    last_s = pose.time_s;
    line.x.push_back(x(pose));
    line.y.push_back(y(pose));
  }
  return line;
}

report::Plot floor_plan(const film::FilmTrack& track) {
  report::Plot plot{"The robot's tag and the tags on the floor",
                    "x in m (axes of the first floor tag)",
                    "y in m",
                    {},
                    true};
  plot.lines.push_back(pose_line(
      track.found.poses, [](const auto& p) { return p.pose.x_m; }, [](const auto& p) { return p.pose.y_m; }));
  report::PlotLine tags;
  tags.points = true;
  for (const film::FloorTag& tag : track.scene.tags) {
    tags.x.push_back(tag.pose.x_m);
    tags.y.push_back(tag.pose.y_m);
    tags.labels.push_back(std::to_string(tag.id));
  }
  plot.lines.push_back(std::move(tags));
  return plot;
}

report::Plot camera_plot(const film::FilmTrack& track) {
  report::Plot plot{"How far the floor tags are from their mean place: to the right (blue), down (red)",
                    "time in the film, s",
                    "px",
                    {},
                    false};
  report::PlotLine right, down;
  for (const film::PictureMotion& motion : track.motion.course) {
    right.x.push_back(motion.pts_s);
    right.y.push_back(motion.shift_px.x());
    down.x.push_back(motion.pts_s);
    down.y.push_back(motion.shift_px.y());
  }
  plot.lines = {std::move(right), std::move(down)};
  return plot;
}

/// The report on a film: what `film_text` says, the preview, and plots of the path, of the corners' residuals and of the
/// camera's motion.
report::FilmReportInput film_page(const fs::path& film, const film::FilmTrack& track,
                                  std::vector<std::uint8_t> preview_png) {
  const auto& poses = track.found.poses;
  const auto time = [](const film::FilmPose& pose) { return pose.time_s; };
  report::FilmReportInput page;
  page.title = "Film " + film.filename().string();
  for (const auto& row : film_table(track)) page.description.push_back({row.front(), row.back()});
  for (const Remark& remark : track.remarks) page.remarks.push_back(in_words(remark));
  page.preview_png = std::move(preview_png);
  page.plots.push_back(floor_plan(track));
  page.plots.push_back({"What remains of the corners of the robot's tag",
                        "time in the film, s",
                        "px, rms",
                        {pose_line(poses, time, [](const auto& p) { return p.rms_px; })},
                        false});
  page.plots.push_back(
      {"Speed of the robot's tag",
       "time in the film, s",
       "m/s",
       {pose_line(poses, time, [](const auto& p) { return std::hypot(p.velocity.x_mps, p.velocity.y_mps); })},
       false});
  page.plots.push_back(camera_plot(track));
  return page;
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
  // The result is printed before this error, so that a person sees where the robot left the picture.
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
