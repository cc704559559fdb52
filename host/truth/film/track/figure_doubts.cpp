#include "host/truth/film/track/figure_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/truth/film/track/scene_search.hpp"

namespace astro::film {
namespace {

constexpr double kDoubtful = 3.5;  // standard errors; one in two thousand figures that are right

bool is_given(const FilmFigures& given, FigureKind kind) {
  switch (kind) {
    case FigureKind::floor_side:
      return given.floor_side_m.has_value();
    case FigureKind::robot_side:
      return given.robot_side_m.has_value();
    case FigureKind::robot_height:
      return given.robot_height_m.has_value();
    default:
      return true;
  }
}

FilmFigures without(FilmFigures given, const FigureCheck& figure) {
  switch (figure.kind) {
    case FigureKind::floor_side:
      given.floor_side_m.reset();
      break;
    case FigureKind::robot_side:
      given.robot_side_m.reset();
      break;
    case FigureKind::robot_height:
      given.robot_height_m.reset();
      break;
    default:
      given.tapes.erase(given.tapes.begin() + static_cast<std::ptrdiff_t>(figure.tape));
  }
  return given;
}

/// What this figure is without it, from the scene that was found so.
double value_in(const Scene& scene, const FilmFigures& given, const FigureCheck& figure) {
  switch (figure.kind) {
    case FigureKind::floor_side:
      return scene.floor_side_m;
    case FigureKind::robot_side:
      return scene.robot_side_m;
    case FigureKind::robot_height:
      return scene.robot_height_m;
    default: {
      const FilmFigures::Length& tape = given.tapes[figure.tape];
      return distance_between(scene, tape.from, tape.to).value_or(0);
    }
  }
}

std::string name_of(const FilmFigures& given, const FigureCheck& figure) {
  switch (figure.kind) {
    case FigureKind::floor_side:
      return "the side of the floor tags";
    case FigureKind::robot_side:
      return "the side of the robot's tag";
    case FigureKind::robot_height:
      return "the height of the robot's tag";
    default:
      return fmt::format("the distance from floor tag {} to {}", given.tapes[figure.tape].from,
                         given.tapes[figure.tape].to);
  }
}

std::string length(double length_m) {
  return length_m < 1 ? fmt::format("{:.1f} mm", 1e3 * length_m) : fmt::format("{:.3f} m", length_m);
}

double worst(const std::vector<FigureCheck>& checks) {
  double most = 0;
  for (const FigureCheck& one : checks) most = std::max(most, one.off());
  return most;
}

/// By how much what was measured and how the sheets are printed contradict each other, in standard errors.
double contradiction(const FilmFigures& given, const SceneFit& fit) {
  return worst(check_figures(fit.scene, figures_with_errors(given), fit.covariance));
}

/// With a height or a side that is far off, the robot's tag fits no picture, and then says nothing against it.
bool shows_robot(const SceneFit& fit) {
  constexpr double kFits_px = 1;
  return !fit.robot.empty() && fit.robot_rms_px < kFits_px;
}

/// Refits with other figures; the scene if those agree.
std::optional<Scene> agreeing_scene(const FilmFigures& others, const Refit& refit) {
  try {
    const SceneFit fit = refit(others);
    if (fit.converged && shows_robot(fit) && contradiction(others, fit) < kDoubtful) return fit.scene;
  } catch (const Error&) {  // no camera fits: these figures explain nothing
  }
  return std::nullopt;
}

/// A figure that explains the contradiction if it is left out, and what it would be.
struct Culprit {
  FigureCheck figure;
  double value_m;
};

bool is_gross(const Culprit& culprit) {
  constexpr double kPart = 0.05, kHeight_m = 0.03;
  const double off_m = std::abs(culprit.figure.measured.value - culprit.value_m);
  return off_m > (culprit.figure.kind == FigureKind::robot_height ? kHeight_m : kPart * culprit.value_m);
}

std::optional<std::string> exchange(const FilmFigures& given, const Refit& refit) {
  const auto try_pair = [&](std::optional<double> FilmFigures::*a, std::optional<double> FilmFigures::*b,
                            const char* names) -> std::optional<std::string> {
    if (!(given.*a) || !(given.*b)) return std::nullopt;
    FilmFigures other = given;
    std::swap(other.*a, other.*b);
    if (!agreeing_scene(other, refit)) return std::nullopt;
    return fmt::format("{}, {} and {}, are exchanged", names, length(*(given.*a)), length(*(given.*b)));
  };
  if (auto sides = try_pair(&FilmFigures::robot_side_m, &FilmFigures::floor_side_m,
                            "the sides of the robot's tag and of the floor tags"))
    return sides;
  return try_pair(&FilmFigures::robot_side_m, &FilmFigures::robot_height_m,
                  "side and height of the robot's tag");
}

}  // namespace

std::vector<FigureCheck> given_figures(const FilmFigures& given, const SceneFit& fit) {
  std::vector<FigureCheck> checks = check_figures(fit.scene, figures_with_errors(given), fit.covariance);
  std::erase_if(checks, [&](const FigureCheck& one) { return !is_given(given, one.kind); });
  return checks;
}

std::optional<FigureDoubt> doubt_about_figures(const FilmFigures& given, const SceneFit& fit,
                                               const Refit& refit) {
  const double off = contradiction(given, fit);
  const bool robot_fits = shows_robot(fit);
  if (off < kDoubtful && robot_fits) return std::nullopt;
  const std::vector<FigureCheck> checks = given_figures(given, fit);
  std::vector<Culprit> culprits;
  for (const FigureCheck& figure : checks)
    if (const auto scene = agreeing_scene(without(given, figure), refit))
      culprits.push_back({figure, value_in(*scene, given, figure)});
  if (const auto exchanged = exchange(given, refit); exchanged && culprits.size() != 1)
    return FigureDoubt{{*exchanged}, off, true};
  const auto clause = [&](const Culprit& one) {
    return fmt::format("{} is {} and not {}", name_of(given, one.figure), length(one.value_m),
                       length(one.figure.measured.value));
  };
  if (culprits.size() == 1) {
    const Culprit& one = culprits.front();
    return FigureDoubt{
        {"by the film and all else that was measured, " + clause(one), {Help::measure_figure_again}},
        off,
        is_gross(one)};
  }
  const bool none = culprits.empty();
  if (none && !robot_fits) return std::nullopt;  // no figure is to blame
  if (none)
    for (const FigureCheck& figure : checks) culprits.push_back({figure, figure.by_others.value});
  std::vector<std::string> clauses;
  bool gross = true;
  for (const Culprit& one : culprits) {
    clauses.push_back(clause(one));
    gross = gross && (none || is_gross(one));
  }
  return FigureDoubt{
      {fmt::format("what was measured contradicts itself: either {}", fmt::join(clauses, ", or ")),
       {Help::measure_figure_again}},
      off,
      gross};
}

}  // namespace astro::film
