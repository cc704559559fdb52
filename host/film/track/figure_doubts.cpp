#include "host/film/track/figure_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/film/track/scene_search.hpp"

namespace astro::film {
namespace {

constexpr double kDoubtful = 3.5;  // standard errors; one in two thousand correct figures is as far off
constexpr double kUneasy = 2;      // one in twenty is

using FigureMember = std::optional<double> FilmFigures::*;

/// Nothing for a tape, of which there may be several.
FigureMember member_of(FigureKind kind) {
  switch (kind) {
    case FigureKind::floor_side:
      return &FilmFigures::floor_side_m;
    case FigureKind::robot_side:
      return &FilmFigures::robot_side_m;
    case FigureKind::robot_height:
      return &FilmFigures::robot_height_m;
    default:
      return nullptr;
  }
}

bool is_given(const FilmFigures& given, FigureKind kind) {
  const FigureMember member = member_of(kind);
  return member == nullptr || (given.*member).has_value();
}

FilmFigures without(FilmFigures given, const FigureCheck& figure) {
  if (const FigureMember member = member_of(figure.kind); member != nullptr)
    (given.*member).reset();
  else
    given.tapes.erase(given.tapes.begin() + static_cast<std::ptrdiff_t>(figure.tape));
  return given;
}

/// The value of a figure in a scene that was found without it.
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

/// Whether the robot's tag fits the pictures. With a height or a side that is far off it fits none, and then
/// does not contradict that figure.
bool shows_robot(const SceneFit& fit) {
  constexpr double kFits_px = 1;
  return !fit.robot.empty() && fit.robot_rms_px < kFits_px;
}

/// Refits with other figures. Nothing unless these agree, and the robot's tag is above the floor.
std::optional<SceneFit> agreeing_fit(const FilmFigures& others, const Refit& refit) {
  try {
    SceneFit fit = refit(others);
    if (fit.converged && shows_robot(fit) && fit.scene.robot_height_m >= 0 &&
        worst(given_figures(others, fit)) < kDoubtful)
      return fit;
  } catch (const Interrupted&) {
    throw;
  } catch (const Error&) {  // if no camera fits, these figures are no explanation
  }
  return std::nullopt;
}

/// A wrong figure, and its corrected value.
struct Correction {
  FigureCheck figure;
  double value_m;
};

bool is_gross(const FilmFigures& given, const Correction& one) {
  constexpr double kPart = 0.05, kHeight_m = 0.03;
  const double off_m = std::abs(one.figure.measured.value - one.value_m);
  const bool far =
      off_m > (one.figure.kind == FigureKind::robot_height ? kHeight_m : kPart * std::abs(one.value_m));
  return far && without(given, one.figure).scale_measured();
}

struct Explanation {
  std::string clause;
  std::vector<std::string> values;  // in the clause
  bool gross;
};

Explanation by_figure(const FilmFigures& given, const Correction& one) {
  const std::string name = name_of(given, one.figure), found = length(one.value_m),
                    stated = length(one.figure.measured.value);
  return {
      fmt::format("{} is {} and not {}", name, found, stated), {name, found, stated}, is_gross(given, one)};
}

/// A remark that begins with `begins` and lists all explanations, separated by `joint`.
Remark together(const std::string& begins, const std::vector<Explanation>& all, const char* joint,
                FilmProblem kind) {
  std::vector<std::string> clauses, values;
  for (const Explanation& one : all) {
    clauses.push_back(one.clause);
    values.insert(values.end(), one.values.begin(), one.values.end());
  }
  return {fmt::format("{}{}: measure that again, or leave it out", begins, fmt::join(clauses, joint)), kind,
          std::move(values)};
}

bool all_gross(const std::vector<Explanation>& all) { return std::ranges::all_of(all, &Explanation::gross); }

/// An assumed figure is unusual: continues without the assumption. unusual_sides() reports the sides.
std::optional<FigureDoubt> unusual(const FilmFigures& given, const Refit& refit) {
  if (given.floor_side_m && given.robot_side_m && given.robot_height_m) return std::nullopt;
  FilmFigures open = given;
  open.as_usual = false;
  const auto fit = agreeing_fit(open, refit);
  if (!fit) return std::nullopt;
  FigureDoubt doubt{{}, false, open, fit};
  constexpr double kNotable = 1.5;  // standard errors of what is usual
  const Measured usual = figures_with_errors(given).robot_height_m;
  if (!given.robot_height_m && std::abs(fit->scene.robot_height_m - usual.value) > kNotable * usual.sigma)
    doubt.remark = {
        fmt::format("by the film and what was measured, the height of the robot's tag is {} and not {}, as "
                    "is usual",
                    length(fit->scene.robot_height_m), length(usual.value)),
        FilmProblem::unusual_height};
  return doubt;
}

std::optional<Remark> exchange(const FilmFigures& given, const Refit& refit) {
  const auto try_pair = [&](FigureMember a, FigureMember b, const char* names) -> std::optional<Remark> {
    if (!(given.*a) || !(given.*b)) return std::nullopt;
    FilmFigures other = given;
    std::swap(other.*a, other.*b);
    if (!agreeing_fit(other, refit)) return std::nullopt;
    const std::string first = length(*(given.*a)), second = length(*(given.*b));
    return Remark{fmt::format("{}, {} and {}, are exchanged", names, first, second),
                  FilmProblem::figures_exchanged,
                  {names, first, second}};
  };
  if (auto sides = try_pair(&FilmFigures::robot_side_m, &FilmFigures::floor_side_m,
                            "the sides of the robot's tag and of the floor tags"))
    return sides;
  return try_pair(&FilmFigures::robot_side_m, &FilmFigures::robot_height_m,
                  "side and height of the robot's tag");
}

/// Both sides are wrong by a common factor, as a printer scales.
std::optional<Explanation> printed_smaller(const FilmFigures& given, const Refit& refit) {
  constexpr double kSame = 0.015;
  if (!given.floor_side_m || !given.robot_side_m || given.tapes.empty()) return std::nullopt;
  FilmFigures others = given;
  others.floor_side_m.reset();
  others.robot_side_m.reset();
  const auto fit = agreeing_fit(others, refit);
  if (!fit) return std::nullopt;
  const double floor = fit->scene.floor_side_m / *given.floor_side_m,
               robot = fit->scene.robot_side_m / *given.robot_side_m;
  constexpr double kLeastPrinted = 0.85, kMostPrinted = 1.01;  // printers shrink to fit a page
  const double mean = (floor + robot) / 2;
  if (std::abs(floor - robot) > kSame || mean < kLeastPrinted || mean > kMostPrinted) return std::nullopt;
  const std::string percent = fmt::format("{:.1f}", 100 * mean);
  return Explanation{
      fmt::format("all tags are printed at {} % of the sides that were given", percent), {percent}, false};
}

std::vector<Explanation> explanations(const FilmFigures& given, const std::vector<FigureCheck>& checks,
                                      const Refit& refit) {
  std::vector<Explanation> all;
  for (const FigureCheck& figure : checks)
    if (const auto fit = agreeing_fit(without(given, figure), refit))
      all.push_back(by_figure(given, {figure, value_in(fit->scene, given, figure)}));
  if (const auto smaller = printed_smaller(given, refit)) all.push_back(*smaller);
  return all;
}

/// No single figure explains it.
FigureDoubt several(const FilmFigures& given, const std::vector<FigureCheck>& checks) {
  std::vector<Explanation> all;
  for (const FigureCheck& figure : checks)
    if (figure.off() >= kDoubtful) all.push_back(by_figure(given, {figure, figure.by_others.value}));
  return {together("at least two of what was measured are wrong; each by all else, ", all, ", ",
                   FilmProblem::several_figures_wrong),
          all_gross(all), given};
}

}  // namespace

std::vector<FigureCheck> given_figures(const FilmFigures& given, const SceneFit& fit) {
  std::vector<FigureCheck> checks = check_figures(fit.scene, figures_with_errors(given), fit.covariance);
  std::erase_if(checks, [&](const FigureCheck& one) { return !is_given(given, one.kind); });
  return checks;
}

double growth_of_error(const std::vector<FigureCheck>& checks) {
  const double off = worst(checks);
  return off > kUneasy ? off : 1;
}

std::vector<UnusualSide> unusual_sides(const FilmFigures& given, const Scene& scene) {
  constexpr double kUnusual = 0.03;  // caused by a printer that fits sheets to the page, or by a wrong figure
  const Figures usual = figures_with_errors(FilmFigures{});
  std::vector<UnusualSide> all;
  const auto look = [&](FigureKind kind, double usual_m, double found_m) {
    const UnusualSide side{kind, usual_m, found_m};
    if (!is_given(given, kind) && side.part() > kUnusual) all.push_back(side);
  };
  look(FigureKind::floor_side, usual.floor_side_m.value, scene.floor_side_m);
  look(FigureKind::robot_side, usual.robot_side_m.value, scene.robot_side_m);
  return all;
}

std::optional<FigureDoubt> doubt_about_figures(const FilmFigures& given, const SceneFit& fit,
                                               const Refit& refit) {
  const std::vector<FigureCheck> checks = given_figures(given, fit);
  const double off = worst(checks);
  const bool robot_fits = shows_robot(fit);
  if (checks.empty() || (off < kDoubtful && robot_fits)) return std::nullopt;
  if (auto other = unusual(given, refit)) return other;
  const std::vector<Explanation> all = explanations(given, checks, refit);
  if (all.size() != 1)
    if (const auto exchanged = exchange(given, refit)) return FigureDoubt{*exchanged, true, given};
  if (all.empty() && (!robot_fits || off < kDoubtful)) return std::nullopt;  // no figure explains it
  if (all.empty()) return several(given, checks);
  const Remark remark = all.size() == 1 ? together("by the film and all else that was measured, ", all, "",
                                                   FilmProblem::figure_wrong)
                                        : together("what was measured contradicts itself: either ", all,
                                                   ", or ", FilmProblem::figures_contradict);
  // Without the robot's tag nothing can be computed.
  return FigureDoubt{remark, all_gross(all) || !robot_fits, given};
}

}  // namespace astro::film
