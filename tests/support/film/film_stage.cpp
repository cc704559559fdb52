#include "tests/support/film/film_stage.hpp"

#include <array>
#include <random>

namespace astro::support::film {
namespace {

constexpr double kRobotTag_m = 0.1201, kFloorTag_m = 0.1599;  // as the printer made them

}  // namespace

Lens main_lens() { return {1920, 1080, 1507, 971.5, 531.5, 0.08, -0.15}; }
Lens wide_lens() { return {1920, 1080, 1140, 952.0, 546.0, -0.05, 0.012}; }

Lens at_720p(const Lens& lens) {
  Lens small = lens;
  small.width_px = 1280;
  small.height_px = 720;
  small.f_px = lens.f_px * 2 / 3;
  small.cx_px = (lens.cx_px + 0.5) * 2 / 3 - 0.5;
  small.cy_px = (lens.cy_px + 0.5) * 2 / 3 - 0.5;
  return small;
}

Camera on_shelf() { return looking_at({0.1, -1.75, 2.0}, {0.06, 0.55, 0}, 2 * kDegree); }
Camera on_stairs() { return looking_at({-0.1, -1.15, 2.15}, {0.02, 0.62, 0}, -1.5 * kDegree); }
Camera at_ceiling(double height_m) { return looking_at({0.05, 0.42, height_m}, {0.02, 0.5, 0}, 1 * kDegree); }

std::vector<FloorTag> tags_around(bool overhead, double bulge_m) {
  struct Spot {
    double x_m, y_m, yaw_deg;
  };
  constexpr std::array<Spot, 6> kOblique{{{-1.25, -0.22, -73},
                                          {1.28, -0.20, -16},
                                          {-1.72, 1.45, -6},
                                          {1.75, 1.50, -7},
                                          {0.05, 1.72, 95},
                                          {0.0, -0.42, -10}}};
  constexpr std::array<Spot, 6> kOverhead{{{-1.30, -0.05, 12},
                                           {1.31, -0.02, 80},
                                           {-1.28, 1.02, -35},
                                           {1.29, 1.00, 5},
                                           {-0.50, 0.52, 48},
                                           {0.52, 0.48, -20}}};
  std::vector<FloorTag> tags;
  double up = 1;
  for (const Spot& spot : overhead ? kOverhead : kOblique) {
    const int id = static_cast<int>(tags.size()) + 1;
    up = -up;
    tags.push_back({TagPaper(id, kFloorTag_m), {spot.x_m, spot.y_m, spot.yaw_deg * kDegree}, up * bulge_m});
  }
  return tags;
}

sim::Config uncalibrated_robot(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  sim::Config config;
  config.true_ed = 1 + 0.006 * uniform(random);
  config.scale = 1 + 0.004 * uniform(random);
  config.true_wheelbase_m = config.nominal_wheelbase_m * (1 + 0.01 * uniform(random));
  config.slip_m = 2.6e-6;
  config.seed = seed;
  return config;
}

FilmedRobot filmed(const PoseTrack& track) {
  FilmedRobot robot{track, TagPaper(0, kRobotTag_m)};
  robot.lever = {0.020, -0.010, 3 * kDegree};
  robot.tilt_x_rad = 0.3 * kDegree;
  robot.tilt_y_rad = -0.2 * kDegree;
  return robot;
}

FilmCase staged(const std::string& name, const std::string& what, std::uint64_t seed,
                const std::vector<DriveWish>& wishes, std::vector<FloorTag> floor) {
  const sim::Config robot = uncalibrated_robot(seed);
  const FilmedDrives drives = film_drives(robot, {0, 0, 94 * kDegree}, wishes, 1.5);
  FilmCase film{name, what, robot, drives, {}, {}};
  film.setup.scene.floor = std::move(floor);
  film.setup.scene.robots.push_back(filmed(drives.track));
  film.setup.begin_s = drives.track.begin_s() + 0.2;
  film.setup.end_s = drives.track.end_s() - 0.2;
  film.setup.clock.seed = film.setup.seed = seed;
  film.setup.clock.skew = seed % 2 == 0 ? 3e-5 : -2e-5;
  const FloorPose from = film.setup.scene.floor[0].pose, to = film.setup.scene.floor[3].pose;
  const double distance_m = std::hypot(from.x_m - to.x_m, from.y_m - to.y_m);
  const double tape_off_m = seed % 3 == 0 ? 0.0015 : -0.001;
  film.stated = {0.1200, film.setup.scene.robots[0].height_m + 0.001, 0.1600, 0, 3, distance_m + tape_off_m};
  return film;
}

void make_noisy(FilmSetup& setup) {
  setup.sensor.read_noise = 0.006;
  setup.sensor.shot_noise = 6e-4;
}

}  // namespace astro::support::film
