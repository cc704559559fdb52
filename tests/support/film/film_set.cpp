#include "tests/support/film/film_set.hpp"

#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>

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

/// Nothing if there is none of that name.
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

struct Phone {
  const char* name;
  bool wide, small, overhead, noisy;
  double fps, readout_s, mbit_per_s;
  const char* untold;  // what the film has that no estimator models
};

constexpr Phone kPhones[] = {
    {"main-1080p30-oblique", false, false, false, false, 30, 0.020, 14, "a leg"},
    {"main-1080p30-oblique-noisy", false, false, false, true, 30, 0.020, 2, "floor tags 3 mm off the plane"},
    {"main-1080p30-overhead", false, false, true, false, 30, 0.024, 14, "nothing"},
    {"main-1080p60-oblique", false, false, false, false, 60, 0.012, 14,
     "k3 and tangential distortion, a leg"},
    {"main-720p60-oblique", false, true, false, false, 60, 0.012, 2, "another tone curve"},
    {"main-720p30-oblique-noisy", false, true, false, true, 30, 0.020, 4, "nothing"},
    {"wide-1080p30-oblique", true, false, false, false, 30, -0.020, 8,
     "rows read upwards, tangential distortion"},
    {"wide-1080p60-overhead-noisy", true, false, true, true, 60, 0.014, 8, "nothing"},
    {"wide-720p30-overhead", true, true, true, false, 30, 0.020, 1, "floor tags 2 mm off the plane"},
    {"main-1080p30-oblique-sagging", false, false, false, false, 30, 0.020, 14,
     "a camera that sags by 2 pixels"},
};

Camera camera_of(const Phone& phone) {
  if (phone.overhead) return at_ceiling(phone.wide ? 2.0 : 2.5);
  return phone.wide ? on_stairs() : on_shelf();
}

void add_untold(const std::string& untold, FilmCase& film) {
  FilmSetup& setup = film.setup;
  const auto has = [&](const char* what) { return untold.find(what) != std::string::npos; };
  if (has("tangential")) setup.lens.p1 = 2e-4, setup.lens.p2 = -1.5e-4;
  if (has("k3")) setup.lens.k3 = 0.02;
  if (has("tone")) setup.sensor.tone = Tone::power;
  if (has("leg")) {
    const double when_s = setup.begin_s + 12;
    setup.scene.legs.push_back({when_s, when_s + 2.5, {-1.9, 0.4, 0}, {-1.2, 1.9, 0}});
  }
  if (has("sags")) {
    const double per_s = 2 / setup.lens.f_px / (setup.end_s - setup.begin_s);
    setup.camera = [from = setup.camera(0), per_s](double pts_s) { return turned(from, per_s * pts_s, 0); };
  }
}

FilmCase good_film(const Phone& phone, std::uint64_t seed) {
  const std::string untold = phone.untold;
  const double bulge_m = untold.find("3 mm") != std::string::npos   ? 0.003
                         : untold.find("2 mm") != std::string::npos ? 0.002
                                                                    : 0;
  FilmCase film =
      staged(phone.name, "two squares; untold: " + untold, seed,
             {square_wish(1, Sense::ccw), square_wish(1, Sense::cw)}, tags_around(phone.overhead, bulge_m));
  const Lens lens = phone.wide ? wide_lens() : main_lens();
  film.setup.lens = phone.small ? at_720p(lens) : lens;
  film.setup.camera = [camera = camera_of(phone)](double) { return camera; };
  film.setup.shutter = {phone.readout_s, phone.fps > 30 ? 0.005 : 0.008};
  film.setup.clock.fps = phone.fps;
  film.setup.codec.mbit_per_s = phone.mbit_per_s;
  if (phone.noisy) make_noisy(film.setup);
  add_untold(untold, film);
  return film;
}

}  // namespace

std::vector<std::string> wrong_film_names() {
  std::vector<std::string> names;
  for (const auto& [name, flaw] : flaws()) names.push_back(name);
  return names;
}

std::vector<std::string> good_film_names() {
  std::vector<std::string> names;
  for (const Phone& phone : kPhones) names.emplace_back(phone.name);
  return names;
}

FilmCase film_case(const std::string& name) {
  std::uint64_t seed = 101;
  for (const Phone& phone : kPhones) {
    if (name == phone.name) return good_film(phone, seed);
    ++seed;
  }
  if (std::optional<FilmCase> wrong = wrong_film(name)) return *wrong;
  throw std::logic_error("there is no film " + name);
}

}  // namespace astro::support::film
