#include "host/report/squares.hpp"

#include <fmt/core.h>

#include <cmath>

#include "host/base/text/sense.hpp"
#include "host/report/comparison.hpp"
#include "host/report/html.hpp"
#include "host/report/numbers.hpp"

namespace astro::report {

using calibration::FigureOfMerit;

bool has_squares(const Phase& phase) { return !phase.cw.empty() && !phase.ccw.empty(); }

std::vector<SquarePhase> square_phases(const ReportInput& input) {
  std::vector<SquarePhase> out;
  for (std::size_t i = 0; i < input.phases.size(); ++i) {
    if (has_squares(input.phases[i])) out.push_back({i, &input.phases[i]});
  }
  return out;
}

FigureOfMerit largest_error_mm(const Phase& phase) { return E_max_syst_mm(phase.squares); }

namespace {

std::string phase_value(const SquarePhase& square) {
  const FigureOfMerit e = largest_error_mm(*square.phase);
  return fmt::format(
      R"(<li class="phase-{}"><span class="label">{}</span> <span class="value"><strong>{}</strong>{}</span></li>)",
      square.index % kAccents, escape(capitalised(square.phase->title)),
      fixed(e.value, decimals_for(e.standard_error, e.value < 10 ? 2 : 1)),
      std::isfinite(e.standard_error)
          ? " ± " + fixed(e.standard_error, decimals_for(e.standard_error, 1)) + " mm"
          : " mm");
}

std::string comparison(const Phase& first, const Phase& last) {
  const FigureOfMerit before = largest_error_mm(first), after = largest_error_mm(last);
  const calibration::Improvement gain = calibration::improvement(before, after);
  return fmt::format(
      R"(<p class="gain"><strong>{}</strong> <span class="detail">improvement factor {}</span></p>
<p class="sentence">{}</p>)",
      claim(gain), describe(gain), verdict_sentence(before, after));
}

std::string direction_text(const char* name, const calibration::ClusterSummary& c) {
  return fmt::format("{} centre of gravity x {} mm, y {} mm, distance {} mm", name, fixed(c.x_cg_m * 1e3, 1),
                     fixed(c.y_cg_m * 1e3, 1), fixed(c.r_cg_m * 1e3, 1));
}

std::string cluster_text(const Phase& phase) {
  return fmt::format("{}: {}; {}.", phase.title, direction_text(in_words(Sense::cw), phase.squares.cw),
                     direction_text(in_words(Sense::ccw), phase.squares.ccw));
}

}  // namespace

Section headline(const ReportInput& input) {
  Section out{"result", "Result", ""};
  const auto squares = square_phases(input);
  if (squares.empty()) return out;
  std::string chain, alt;
  for (const auto& s : squares) {
    chain += phase_value(s);
    alt += cluster_text(*s.phase) + " ";
  }
  out.body = fmt::format(
      R"(<div class="headline"><div>
<p class="what">Largest systematic error of the square, <var>E</var><sub>max,syst</sub></p>
<ol class="chain">{}</ol>
{}
</div>
<figure data-figure="merit"><figcaption>Distance <var>r</var><sub>cg</sub> of the mean end error from zero, with its standard error</figcaption>
<div class="plot" role="img" aria-label="{}"></div></figure></div>)",
      chain, squares.size() > 1 ? comparison(*squares.front().phase, *squares.back().phase) : "",
      escape(alt));
  return out;
}

Section scatter(const ReportInput& input) {
  Section out{"end-errors", "End errors of the squares", ""};
  std::string panels;
  for (const auto& s : square_phases(input)) {
    panels += fmt::format(
        R"(<figure data-figure="scatter" data-phase="{}"><figcaption class="phase-{}">{}</figcaption>
<div class="plot" role="img" aria-label="End errors {}"></div></figure>)",
        s.index, s.index % kAccents, escape(capitalised(s.phase->title)), escape(cluster_text(*s.phase)));
  }
  if (panels.empty()) return out;
  out.body = R"(<p>Each mark is one run: ground truth minus odometry at its end, in the frame of its start.
Large marks are the means (centres of gravity) with their standard errors; the circles about zero pass through them
(radius <var>r</var><sub>cg</sub>), dashed for clockwise and dotted for counter-clockwise.</p>
<fieldset class="selector" data-scale><legend>Scale</legend>
<label><input type="radio" name="scale" value="same" autocomplete="off" checked><span>the same for all</span></label>
<label><input type="radio" name="scale" value="own" autocomplete="off"><span>each its own</span></label></fieldset>
<div class="panels">)" +
             panels + "</div>";
  return out;
}

}  // namespace astro::report
