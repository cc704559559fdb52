#include "host/commands/truth/truth_film_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/base/text/columns.hpp"
#include "host/base/text/degrees.hpp"
#include "host/commands/base/advice.hpp"
#include "host/console/console.hpp"

namespace astro::commands {
namespace {

using film::FilmTrack;
using Rows = std::vector<std::vector<std::string>>;

double down_deg(const film::Camera& camera) {
  return degrees(std::asin(std::clamp(-camera.rotation(2, 2), -1.0, 1.0)));
}

/// Root mean squares of the poses' own standard errors.
struct PoseErrors {
  double position_m = 0, heading_rad = 0;
};

PoseErrors errors_of(const film::FilmPoses& found) {
  double position = 0, heading = 0;
  const double count = std::max(1.0, static_cast<double>(found.poses.size()));
  for (const film::FilmPose& pose : found.poses) {
    position += (pose.covariance(0, 0) + pose.covariance(1, 1)) / 2 / count;
    heading += pose.covariance(2, 2) / count;
  }
  return {std::sqrt(position), std::sqrt(heading)};
}

Rows film_rows(const FilmTrack& track) {
  const film::FilmInfo& info = track.info;
  const film::FilmSightings& seen = track.sightings;
  return {{"film", fmt::format("{} x {}, {}, {:.1f} s, {} pictures, {:.2f} a second on average", info.width,
                               info.height, info.codec, seen.last_s - seen.first_s, seen.pictures,
                               info.frames_per_s)},
          {"robot's tag",
           fmt::format("id {}, in {} of {} pictures; {} of these fit no tag and are left out",
                       track.figures.robot_id, seen.robot.size(), seen.pictures, track.found.dropped)}};
}

Rows camera_rows(const FilmTrack& track) {
  const film::Camera& c = track.scene.camera;
  return {
      {"camera", fmt::format("{:.2f} m above the floor, looks {:.0f}° down", c.position_m.z(), down_deg(c))},
      {"lens", fmt::format("focal length {:.0f} px, centre {:.1f}, {:.1f} px, k1 {:+.3f}, k2 {:+.3f}", c.f_px,
                           c.cx_px, c.cy_px, c.k1, c.k2)},
      {"moved by",
       fmt::format("{:.2f} px in all, shakes by {:.2f} px", track.motion.most_px, track.motion.shake_px)},
      {"tag height", fmt::format("{:.1f} mm", 1e3 * track.scene.robot_height_m)},
      {"sides", fmt::format("floor {:.2f} mm, robot {:.2f} mm", 1e3 * track.scene.floor_side_m,
                            1e3 * track.scene.robot_side_m)}};
}

Rows error_rows(const FilmTrack& track) {
  const PoseErrors errors = errors_of(track.found);
  return {
      {"corners", fmt::format("{:.2f} px robot, {:.2f} px floor", track.found.corner_px, track.floor_rms_px)},
      {"poses", fmt::format("{:.2f} mm and {:.1f} mrad for each picture", 1e3 * errors.position_m,
                            1e3 * errors.heading_rad)},
      {"scale", track.figures.scale_measured() ? fmt::format("known to {:.2f} %", 100 * track.scale_sigma)
                                               : std::string("not found")}};
}

std::string floor_rows(const FilmTrack& track) {
  Rows rows{{"floor tag", "x m", "y m", "yaw deg", "px", "seen %", "off px"}};
  for (std::size_t i = 0; i < track.floor.size(); ++i) {
    const film::FloorTag& tag = track.scene.tags[i];
    const film::FloorTagReport& report = track.floor[i];
    rows.push_back({fmt::format("{}", tag.id), fmt::format("{:.4f}", tag.pose.x_m),
                    fmt::format("{:.4f}", tag.pose.y_m), fmt::format("{:.2f}", degrees(tag.pose.theta_rad)),
                    fmt::format("{:.0f}", report.side_px), fmt::format("{:.0f}", 100 * report.seen_share),
                    fmt::format("{:.2f}", report.misfit_px)});
  }
  return console::table(rows);
}

std::string figure_name(const FilmTrack& track, const film::FigureCheck& one) {
  switch (one.kind) {
    case film::FigureKind::floor_side:
      return "side of floor tags";
    case film::FigureKind::robot_side:
      return "side of robot's tag";
    case film::FigureKind::robot_height:
      return "height of robot's tag";
    default: {
      const film::FilmFigures::Length& tape = track.figures.tapes[one.tape];
      return fmt::format("tape {}:{}", tape.from, tape.to);
    }
  }
}

/// Each length that a person measured, beside what the film and the other lengths give without it.
Rows figure_rows(const FilmTrack& track) {
  Rows rows;
  for (const film::FigureCheck& one : track.checked)
    rows.push_back({figure_name(track, one),
                    fmt::format("{:.1f} mm, by all else ", 1e3 * one.measured.value) +
                        (std::isfinite(one.by_others.sigma)
                             ? fmt::format("{:.1f} ± {:.1f} ({:.1f} std errors)", 1e3 * one.by_others.value,
                                           1e3 * one.by_others.sigma, one.off())
                             : "not known")});
  return rows;
}

}  // namespace

std::vector<std::vector<std::string>> film_table(const FilmTrack& track) {
  Rows all = film_rows(track);
  for (const Rows& more : {camera_rows(track), error_rows(track), figure_rows(track)})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string film_text(const FilmTrack& track) {
  std::string text = console::table(film_table(track), "ll") + '\n' + floor_rows(track);
  if (!track.remarks.empty()) text += '\n';
  for (const Remark& remark : track.remarks) text += wrapped(in_words(remark) + '.');
  return text;
}

Json to_json(const FilmTrack& track) {
  const film::Scene& scene = track.scene;
  const film::Camera& c = scene.camera;
  const PoseErrors errors = errors_of(track.found);
  Json checked = Json::array();
  for (const film::FigureCheck& one : track.checked)
    checked.push_back({{"what", figure_name(track, one)},
                       {"measured_m", one.measured.value},
                       {"by_others_m", one.by_others.value},
                       {"by_others_sigma_m", one.by_others.sigma},
                       {"off", one.off()}});
  Json floor = Json::array(), remarks = Json::array(), rotation = Json::array();
  for (std::size_t i = 0; i < track.floor.size(); ++i)
    floor.push_back({{"id", scene.tags[i].id},
                     {"x_m", scene.tags[i].pose.x_m},
                     {"y_m", scene.tags[i].pose.y_m},
                     {"yaw_rad", scene.tags[i].pose.theta_rad},
                     {"side_px", track.floor[i].side_px},
                     {"seen", track.floor[i].seen_share},
                     {"misfit_px", track.floor[i].misfit_px}});
  for (const Remark& remark : track.remarks) remarks.push_back(in_words(remark));
  for (Eigen::Index row = 0; row < 3; ++row)
    rotation.push_back({c.rotation(row, 0), c.rotation(row, 1), c.rotation(row, 2)});
  return {{"width", track.info.width},
          {"height", track.info.height},
          {"pictures", track.sightings.pictures},
          {"seen", track.sightings.robot.size()},
          {"poses", track.found.poses.size()},
          {"first_s", track.sightings.first_s},
          {"last_s", track.sightings.last_s},
          {"longest_gap_s", track.sightings.longest_gap_s},
          {"camera",
           {{"f_px", c.f_px},
            {"cx_px", c.cx_px},
            {"cy_px", c.cy_px},
            {"k1", c.k1},
            {"k2", c.k2},
            {"position_m", {c.position_m.x(), c.position_m.y(), c.position_m.z()}},
            {"rotation", rotation},
            {"readout_s", scene.readout_s},
            {"moved_px", track.motion.most_px},
            {"shake_px", track.motion.shake_px}}},
          {"robot_tag",
           {{"id", track.figures.robot_id},
            {"side_m", scene.robot_side_m},
            {"height_m", scene.robot_height_m},
            {"tilt_rad", {scene.robot_tilt.x(), scene.robot_tilt.y()}},
            {"edge_shift_px", scene.robot_shift_px}}},
          {"floor_side_m", scene.floor_side_m},
          {"floor_edge_shift_px", scene.floor_shift_px},
          {"floor_tags", floor},
          {"measured", checked},
          {"corner_px", track.found.corner_px},
          {"floor_px", track.floor_rms_px},
          {"position_sigma_m", errors.position_m},
          {"heading_sigma_rad", errors.heading_rad},
          {"scale_measured", track.figures.scale_measured()},
          {"scale_sigma", track.scale_sigma},
          {"remarks", remarks}};
}

std::string film_csv(const film::FilmPoses& found) {
  std::string text = "pts_s,time_s,x_m,y_m,theta_rad,sigma_x_m,sigma_y_m,sigma_theta_rad,misfit_px\n";
  for (const film::FilmPose& pose : found.poses)
    text += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{:.3f}\n", pose.pts_s,
                        pose.time_s, pose.pose.x_m, pose.pose.y_m, pose.pose.theta_rad,
                        std::sqrt(pose.covariance(0, 0)), std::sqrt(pose.covariance(1, 1)),
                        std::sqrt(pose.covariance(2, 2)), pose.rms_px);
  return text;
}

std::string film_tum(const film::FilmPoses& found, double height_m) {
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (const film::FilmPose& pose : found.poses)
    text += fmt::format("{:.6f} {:.6f} {:.6f} {:.6f} 0 0 {:.9f} {:.9f}\n", pose.time_s, pose.pose.x_m,
                        pose.pose.y_m, height_m, std::sin(pose.pose.theta_rad / 2),
                        std::cos(pose.pose.theta_rad / 2));
  return text;
}

}  // namespace astro::commands
