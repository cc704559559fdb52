#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "host/experiment/analysis/calibration.hpp"
#include "host/experiment/files/run_set.hpp"
#include "host/film/runs/film_truth.hpp"
#include "tests/support/base/temporary_folder.hpp"
#include "tests/support/film/film_set.hpp"

// The ten good films: each is rendered, followed and calibrated from, with what a user would say about it. Printed per quantity is
// the miss against the simulated robot and, in brackets, the same in standard errors. The bars are 2.5 of them, and for the
// sum of squares of them all what chance leaves 95 times of 100.
//   film_calibration [FOLDER]   keeps the films in FOLDER, and takes those that are there already

namespace {

namespace fs = std::filesystem;
using namespace astro;  // NOLINT(google-build-using-namespace): outside of it stands main() alone
using namespace astro::support::film;  // NOLINT(google-build-using-namespace): this file is all films

constexpr double kBar = 2.5;
constexpr double kLeast = 16.8,
                 kMost = 47.0;  // of chi-square with 30 degrees of freedom, 2.5 % on either side

struct Misses {
  Eigen::Vector3d relative, in_errors;  // of E_d, b / S, S
};

film::FilmFigures figures_of(const FilmCase& film) {
  film::FilmFigures figures;
  figures.robot_side_m = film.stated.robot_tag_m;
  figures.floor_side_m = film.stated.floor_tag_m;
  figures.robot_height_m = film.stated.height_m;
  const auto& tags = film.setup.scene.floor;
  figures.tapes = {
      {tags[film.stated.from].paper.id(), tags[film.stated.to].paper.id(), film.stated.distance_m}};
  return figures;
}

Misses misses_of(const experiment::Calibration& found, const sim::Config& robot) {
  const double scale = found.scale(), base_m = found.factors.b_m / scale;
  const Eigen::Vector3d relative{found.factors.c_r / found.factors.c_l / robot.true_ed - 1,
                                 base_m / (robot.true_wheelbase_m / robot.scale) - 1,
                                 scale / robot.scale - 1};
  const Eigen::Vector3d errors{found.se.E_d / found.E_d(), found.ml()->estimate.se.b_over_scale_m / base_m,
                               found.se.scale / scale};
  return {relative, relative.cwiseQuotient(errors)};
}

Misses judge(const FilmCase& film, const fs::path& folder) {
  if (!fs::exists(folder / "stated.json")) film.write(folder);
  experiment::RunSet set = experiment::read_run_set(folder / "runs");
  film::attach_films(set, {{film.name, film::follow_film(folder / "film.mp4", figures_of(film))}},
                     std::nullopt);
  const experiment::Calibration found = calibrate(set, {experiment::MethodChoice::Family::ml, {}});
  const Misses misses = misses_of(found, film.robot);
  const calibration::MlEstimate& estimate = found.ml()->estimate;
  fmt::print("{:30}", film.name);
  for (int i = 0; i < 3; ++i)
    fmt::print("  {:+7.3f} % ({:+4.1f})", 1e2 * misses.relative[i], misses.in_errors[i]);
  fmt::print("   {:4.2f}\n", estimate.chi_square / estimate.degrees_of_freedom);
  std::fflush(stdout);
  return misses;
}

}  // namespace

int main(int count, char** words) {
  try {
    const test::TemporaryFolder temporary;
    const fs::path folder = count > 1 ? fs::path(words[1]) : temporary.path();
    fmt::print("{:30}  {:16}  {:16}  {:16}   chi-square\n", "film", "E_d", "b/S", "S");
    double worst = 0, sum = 0;
    for (const std::string& name : good_film_names()) {
      const Misses misses = judge(film_case(name), folder / name);
      worst = std::max(worst, misses.in_errors.cwiseAbs().maxCoeff());
      sum += misses.in_errors.squaredNorm();
    }
    fmt::print("worst {:.2f} standard errors (at most {}); sum of squares {:.1f} of 30 ({} to {})\n", worst,
               kBar, sum, kLeast, kMost);
    return worst <= kBar && kLeast <= sum && sum <= kMost ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "film_calibration: {}\n", error.what());
    return 1;
  }
}
