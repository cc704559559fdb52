#include <fmt/format.h>
#include <sys/resource.h>

#include <cstdio>
#include <exception>

#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/film/film_set.hpp"

// What a rendered film costs: processor time of renderer and encoder for a second of film. The bar is the film's own length on
// one core, for 1080p with 30 frames a second.

namespace {

double seconds_of(int who) {
  rusage usage{};
  getrusage(who, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void print_cost(const char* name) {
  const astro::test::TemporaryFolder folder;
  astro::support::film::FilmCase film = astro::support::film::film_case(name);
  film.setup.begin_s += 3;  // it drives by then
  film.setup.end_s = film.setup.begin_s + 10;
  const double own_s = seconds_of(RUSAGE_SELF), encoder_s = seconds_of(RUSAGE_CHILDREN);
  make_film(film.setup, folder.path() / "film.mp4");
  const double own = (seconds_of(RUSAGE_SELF) - own_s) / 10,
               encoder = (seconds_of(RUSAGE_CHILDREN) - encoder_s) / 10;
  fmt::print("{:30} {:4.2f} s to render, {:4.2f} s to encode, {:4.2f} s for a second of film\n", name, own,
             encoder, own + encoder);
}

}  // namespace

int main() {
  try {
    std::puts("film: at most 1 s of processor time for a second of 1080p with 30 frames");
    for (const char* const name : {"main-1080p30-oblique", "main-1080p30-oblique-sagging",
                                   "main-1080p60-oblique", "main-720p30-oblique-noisy", "two-robots"})
      print_cost(name);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "film_speed: {}\n", error.what());
    return 1;
  }
}
