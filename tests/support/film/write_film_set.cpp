#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "tests/support/film/film_set.hpp"

// Writes the films by which an estimator is judged, with their runs and their truth, and says how long each took.
//   film_set FOLDER [good|wrong|NAME...]

namespace {

using namespace astro::support::film;  // NOLINT(google-build-using-namespace)

std::vector<std::string> wanted(int count, char** words) {
  std::vector<std::string> names;
  const auto add = [&](const std::vector<std::string>& more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  for (int word = 2; word < count; ++word) {
    const std::string name = words[word];
    if (name == "good") {
      add(good_film_names());
    } else if (name == "wrong") {
      add(wrong_film_names());
    } else {
      names.push_back(name);
    }
  }
  if (count == 2) add(good_film_names()), add(wrong_film_names());
  return names;
}

void write(const std::string& name, const std::filesystem::path& folder) {
  const auto begin = std::chrono::steady_clock::now();
  const FilmCase film = film_case(name);
  film.write(folder / name);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  std::printf("%-30s %5.1f s of film in %5.1f s   %s\n", name.c_str(), film.setup.end_s - film.setup.begin_s,
              took.count(), film.what.c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** words) {
  if (count < 2) {
    std::fputs("usage: film_set FOLDER [good|wrong|NAME...]\n", stderr);
    return 2;
  }
  try {
    for (const std::string& name : wanted(count, words)) write(name, words[1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "film_set: %s\n", error.what());
    return 1;
  }
}
