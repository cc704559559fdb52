#include "tests/support/film/film_set.hpp"

#include <stdexcept>

#include "tests/support/film/film_stage.hpp"
#include "tests/support/film/wrong_films.hpp"

namespace astro::support::film {
namespace {

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
