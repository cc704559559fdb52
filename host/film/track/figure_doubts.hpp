#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "host/base/error.hpp"
#include "host/film/camera/figure_check.hpp"
#include "host/film/camera/scene_fit.hpp"
#include "host/film/track/film_figures.hpp"

/// A figure that somebody mistyped, measured at the wrong place or gave for another one falsifies the camera and the scale. It
/// can only be recognised because it contradicts the other figures.
namespace astro::film {

/// What is wrong with the figures that people give for a film. Values:
///   distance_to_...        the pair of tags as "1:4"
///   other_tag_moves        its number
///   figure_wrong           the figure, what it is by all else, and what was given
///   figures_contradict     the same of each that may be wrong; of all tags the percentage at which they may
///                          be printed
///   several_figures_wrong  the same of each that is off
///   figures_exchanged      both figures, and what was given for each
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

/// The factor by which the standard error of the scale grows because what was measured agrees badly: 1 up to two standard errors, then as many as they are.
double growth_of_error(const std::vector<FigureCheck>& checks);

/// The side of a tag that nobody gave, and that does not have its printed size according to the given figures. Either the sheets were
/// printed in another size, or a given figure is wrong; the film cannot tell which.
struct UnusualSide {
  FigureKind kind = FigureKind::floor_side;
  double usual_m = 0, found_m = 0;

  double part() const { return std::abs(found_m / usual_m - 1); }
};
/// Those that are more than 3 % off.
std::vector<UnusualSide> unusual_sides(const FilmFigures& given, const Scene& scene);

struct FigureDoubt {
  /// Names the figure, as far as the film shows which one it is, and the value that the others predict; "" if unusual_sides() says it.
  Remark remark;
  bool gross = false;   // too far off for a bad measurement: a mistake, so nothing should be computed with it
  FilmFigures figures;  // to go on with: the given ones, perhaps without those that are assumed
  std::optional<SceneFit> fit = {};  // of these, if they are not those that were given
};

using Refit = std::function<SceneFit(const FilmFigures&)>;

/// Nothing if nothing was measured, or all of it agrees within 3.5 standard errors and the robot's tag fits. Otherwise the scene is found again under
/// each explanation, and the first kind that brings the figures together is said:
///   what nobody gave is not as usual: sheets printed in another size, a robot that is not 0.12 m high; never gross
///   two figures that are easily confused are exchanged
///   one figure is wrong; or both sides by a common factor, as a printer scales; several of these if the film cannot tell them apart
///   more than one is wrong
/// Gross is a mistake of more than 5 % of a length, or 30 mm of the height, that another measured length shows, or with which the
/// robot's tag is not found.
///
/// Cost    none if all agrees, else a `refit` for each explanation.
/// Errors  Interrupted, of `refit`; other errors of `refit` only say that an explanation does not hold.
std::optional<FigureDoubt> doubt_about_figures(const FilmFigures& given, const SceneFit& fit,
                                               const Refit& refit);

}  // namespace astro::film
