#include "tests/support/film/wrong_films.hpp"

#include <cmath>
#include <map>

#include "tests/support/film/film_stage.hpp"

namespace astro::support::film {
namespace {

struct Flaw {
  const char* what;
  void (*spoil)(FilmSetup&);
};

/// The middle of the film, by its stamps.
double middle_s(const FilmSetup& setup) { return (setup.end_s - setup.begin_s) / 2; }

void mirror(FilmSetup& setup) {
  for (FloorTag& tag : setup.scene.floor) tag.paper = TagPaper(tag.paper.id(), tag.paper.side_m(), 1, true);
  TagPaper& paper = setup.scene.robots.front().paper;
  paper = TagPaper(paper.id(), paper.side_m(), 1, true);
}

void stabilise(FilmSetup& setup) {
  // The picture glides by some pixels, as where software takes out what it thinks is a shaking hand.
  setup.camera = [from = setup.camera(0), f_px = setup.lens.f_px](double pts_s) {
    return turned(from, 6 / f_px * std::sin(1.9 * pts_s), 8 / f_px * std::sin(1.1 * pts_s + 0.4));
  };
}

void jolt(FilmSetup& setup) {
  setup.camera = [from = setup.camera(0), f_px = setup.lens.f_px, at_s = middle_s(setup)](double pts_s) {
    return pts_s < at_s ? from : turned(from, 5 / f_px, -7 / f_px);
  };
}

void add_second_robot(FilmSetup& setup) {
  FilmedRobot other = setup.scene.robots.front();
  other.track = PoseTrack::standing({-0.75, 0.45, 0.6});
  setup.scene.robots.push_back(other);
}

const std::map<std::string, Flaw>& flaws() {
  static const std::map<std::string, Flaw> all{
      {"tag-too-small",
       {"the robot's tag is 45 mm and shows as 13 pixels",
        [](FilmSetup& setup) { setup.scene.robots.front().paper = TagPaper(0, 0.045); }}},
      {"blurred", {"the camera is out of focus", [](FilmSetup& setup) { setup.blur_px = 5; }}},
      {"out-of-picture",
       {"the robot drives out of the picture",
        [](FilmSetup& setup) {
          setup.camera = [from = turned(setup.camera(0), 0, 0.46)](double) { return from; };
        }}},
      {"stabilised", {"the picture glides, as with stabilisation", stabilise}},
      {"moved-camera", {"somebody touches the camera in the middle of the drive", jolt}},
      {"cut-film",
       {"two seconds in the middle of the drive were cut out",
        [](FilmSetup& setup) {
          setup.cut = Cut{middle_s(setup) - 1, middle_s(setup) + 1};
        }}},
      {"ends-too-early",
       {"the film ends in the middle of the drive",
        [](FilmSetup& setup) { setup.end_s = setup.begin_s + middle_s(setup); }}},
      {"mirrored-print", {"all tags were printed mirrored", mirror}},
      {"two-robots", {"two robots carry the same tag", add_second_robot}},
  };
  return all;
}

}  // namespace

std::vector<std::string> wrong_film_names() {
  std::vector<std::string> names;
  for (const auto& [name, flaw] : flaws()) names.push_back(name);
  return names;
}

std::optional<FilmCase> wrong_film(const std::string& name) {
  const auto found = flaws().find(name);
  if (found == flaws().end()) return std::nullopt;
  robot::Path path = robot::line(0.5, {0.4, 1.5});
  for (const auto& more : {robot::spin(0.25, {0.4, 1.5}), robot::line(0.3, {0.4, 1.5})})
    path.insert(path.end(), more.begin(), more.end());
  FilmCase film = staged(name, found->second.what, 7, {free_wish("drive-1", path)}, tags_around(false));
  film.setup.lens = at_720p(main_lens());
  film.setup.clock.fps = 15;
  film.setup.camera = [camera = on_shelf()](double) { return camera; };
  found->second.spoil(film.setup);
  return film;
}

}  // namespace astro::support::film
