#pragma once

#include <string>
#include <vector>

#include "tests/support/film/film_folder.hpp"

/// The films by which an estimator is judged: good ones of different phones, and wrong ones that it has to refuse.
namespace astro::support::film {

struct FilmCase {
  std::string name, what;
  sim::Config robot;
  FilmedDrives drives;
  FilmSetup setup;
  Stated stated;

  void write(const std::filesystem::path& folder) const {
    write_film_folder(folder, setup, drives, robot, stated);
  }
};

/// Ten films of two squares of 1 m, one each way. Two lenses, 720p and 1080p, 30 and 60 frames a second, oblique and overhead, much
/// and little noise, rows read downwards and upwards, one camera that sags.
std::vector<std::string> good_film_names();

/// Films of 9 s in 720p with 15 frames a second, each with one flaw.
std::vector<std::string> wrong_film_names();

/// The same name, also of a wrong film, gives the same film. Throws std::logic_error for any other name.
/// Cost    that of driving, 0.2 s; the film is made by write()
FilmCase film_case(const std::string& name);

}  // namespace astro::support::film
