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
  Remark remark;       // which figure it is as far as the film shows it, and what it would be by all else
  double off = 0;      // standard errors of the worst figure
  bool gross = false;  // no measurement is so bad: a mistake, with which nothing should be computed
};

using Refit = std::function<SceneFit(const FilmFigures&)>;

/// Nothing if all figures agree within 3.5 standard errors and the robot's tag fits them. Otherwise the scene is found again without each figure, and with those that
/// are easily confused exchanged; what brings the others together explains it.
///
/// Cost  none if they agree, else one `refit` for each figure.
std::optional<FigureDoubt> doubt_about_figures(const FilmFigures& given, const SceneFit& fit,
                                               const Refit& refit);

}  // namespace astro::film
