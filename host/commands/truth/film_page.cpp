#include "host/commands/truth/film_page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "host/commands/base/remedies.hpp"
#include "host/commands/truth/truth_film_view.hpp"

namespace astro::commands {
namespace {

constexpr double kGap_s = 0.5, kNothing = std::numeric_limits<double>::quiet_NaN();

/// Broken where the tag was hidden.
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
    tags.x.push_back(tag.x_m);
    tags.y.push_back(tag.y_m);
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

}  // namespace

report::FilmReportInput film_page(const std::filesystem::path& film, const film::FilmTrack& track,
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

}  // namespace astro::commands
