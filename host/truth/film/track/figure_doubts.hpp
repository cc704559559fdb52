#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "host/base/remedy.hpp"
#include "host/truth/film/camera/figure_check.hpp"
#include "host/truth/film/camera/scene_fit.hpp"
#include "host/truth/film/track/film_figures.hpp"

/// A figure that somebody mistyped, measured at the wrong place or gave for another one bends camera and scale, and shows only in that
/// the others contradict it.
namespace astro::film {

/// The figures that a person gave, each against all else.
std::vector<FigureCheck> given_figures(const FilmFigures& given, const SceneFit& fit);

struct FigureDoubt {
  Remark remark;        // which figure it is as far as the film shows it, and what it would be by all else
  double off = 1;       // by how much more the scale is uncertain: the standard errors of the worst figure
  bool gross = false;   // no measurement is so bad: a mistake, with which nothing should be computed
  FilmFigures figures;  // with which to go on: those that were given, perhaps without what is usual
};

using Refit = std::function<SceneFit(const FilmFigures&)>;

/// Nothing if nothing was measured, or all of it agrees within 3.5 standard errors and the robot's tag fits. Otherwise the scene is found again under
/// each explanation, and the first kind that brings the figures together is said:
///   what nobody gave is not as usual: sheets printed in another size, a robot that is not 0.12 m high; never gross
///   two figures that are easily confused are exchanged
///   one figure is wrong; or both sides by a common factor, as a printer scales; several of these if the film cannot tell them apart
///   more than one is wrong
/// Gross is a mistake of more than 5 % of a length, or 30 mm of the height, that another measured length shows.
///
/// Cost    none if all agrees, else a `refit` for each explanation.
/// Errors  Interrupted, of `refit`; other errors of `refit` only say that an explanation does not hold.
std::optional<FigureDoubt> doubt_about_figures(const FilmFigures& given, const SceneFit& fit,
                                               const Refit& refit);

}  // namespace astro::film
