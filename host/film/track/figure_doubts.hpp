#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "host/base/error.hpp"
#include "host/film/camera/figure_check.hpp"
#include "host/film/camera/scene_fit.hpp"
#include "host/film/track/film_figures.hpp"

/// A figure that somebody mistyped, measured at the wrong place or confused with another one falsifies the
/// camera and the scale. It can only be recognised because it contradicts the other figures.
namespace astro::film {

/// What is wrong with the figures that people give for a film. Values:
///   distance_to_...        the pair of tags as "1:4"
///   other_tag_moves        its number
///   figure_wrong           the figure, its value by all others, and the given value
///   figures_contradict     the same for each figure that may be wrong; for a printer's scale, the percentage
///   several_figures_wrong  the same for each figure that is off
///   figures_exchanged      both figures, and the given value of each
enum class FilmProblem {
  distance_to_robot,
  distance_to_unseen_tag,
  other_tag_moves,
  no_distance,
  no_height,
  unusual_height,
  figure_wrong,
  figures_contradict,
  several_figures_wrong,
  figures_exchanged
};

/// Compares each figure that a person gave with the value that all others predict.
std::vector<FigureCheck> given_figures(const FilmFigures& given, const SceneFit& fit);

/// The factor by which the standard error of the scale grows because the measured values contradict each
/// other. It is 1 if none is off by more than two standard errors, otherwise the largest number of standard
/// errors.
double growth_of_error(const std::vector<FigureCheck>& checks);

/// The side of a tag that nobody gave, and that does not have its printed size according to the given figures. Either the sheets were
/// printed in another size, or a given figure is wrong; the film cannot tell which.
struct UnusualSide {
  FigureKind kind = FigureKind::floor_side;
  double usual_m = 0, found_m = 0;

  double part() const { return std::abs(found_m / usual_m - 1); }
};
/// The sides that are off by more than 3 %.
std::vector<UnusualSide> unusual_sides(const FilmFigures& given, const Scene& scene);

struct FigureDoubt {
  /// Names the figure, as far as the film shows which one it is, and the value that the others predict; "" if
  /// unusual_sides() reports the problem.
  Remark remark;
  bool gross = false;   // too far off for a bad measurement: a mistake, so nothing should be computed with it
  FilmFigures figures;  // to continue with: the given ones, perhaps without the assumed ones
  std::optional<SceneFit> fit = {};  // with `figures`, if they are not the given ones
};

using Refit = std::function<SceneFit(const FilmFigures&)>;

/// Nothing if nothing was measured, or if all figures agree within 3.5 standard errors and the robot's tag
/// fits. Otherwise refits the scene under each explanation, and reports the first kind that makes the figures
/// agree:
///   an assumed figure is unusual: sheets of another size, a robot that is not 0.12 m high; never gross
///   two figures that are easily confused are exchanged; always gross; not tried if exactly one explanation
///   of the next kind holds
///   one figure is wrong, or both sides by a common factor, as a printer scales; several of these if the film
///   cannot distinguish them
///   more than one figure is wrong
/// A doubt is gross if a length is wrong by more than 5 %, or the height by more than 30 mm, and another
/// measured length shows it, or if the robot's tag is not found with the figure.
///
/// Cost    none if all agrees, else a `refit` for each explanation.
/// Errors  Interrupted, from `refit`. Any other error of `refit` only means that this explanation does not
///         hold.
std::optional<FigureDoubt> doubt_about_figures(const FilmFigures& given, const SceneFit& fit,
                                               const Refit& refit);

}  // namespace astro::film
