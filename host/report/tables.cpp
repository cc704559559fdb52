#include "host/report/tables.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "host/base/text/sense.hpp"
#include "host/report/comparison.hpp"
#include "host/report/html.hpp"
#include "host/report/numbers.hpp"
#include "host/report/squares.hpp"

namespace astro::report {

using calibration::FigureOfMerit;

namespace {

using calibration::ClusterSummary;
using calibration::EndPose;

using Ends = std::vector<EndPose>;

std::string cell(const std::string& content) { return "<td>" + content + "</td>"; }

std::string error_row(const std::string& label, double x_m, double y_m, double r_m, double theta_rad) {
  return "<tr><th scope=\"row\">" + label + "</th>" + cell(fixed(x_m * 1e3, 2)) + cell(fixed(y_m * 1e3, 2)) +
         cell(fixed(r_m * 1e3, 2)) + cell(fixed(theta_rad, 4)) + "</tr>\n";
}

std::string error_table(const std::string& caption, const Ends& ends, const ClusterSummary& s) {
  std::string rows;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const EndPose& e = ends[i];
    rows += error_row(std::to_string(i + 1), e.x_m, e.y_m, std::hypot(e.x_m, e.y_m), e.theta_rad);
  }
  const double unknown = std::nan("");
  return fmt::format(
      R"(<table><caption>{}</caption><thead><tr><th scope="col">Run</th>
<th scope="col"><var>e<sub>x</sub></var> <span class="unit">mm</span></th><th scope="col"><var>e<sub>y</sub></var> <span class="unit">mm</span></th>
<th scope="col"><var>r</var> <span class="unit">mm</span></th><th scope="col"><var>e<sub>θ</sub></var> <span class="unit">rad</span></th></tr></thead>
<tbody>{}</tbody><tfoot>{}{}{}</tfoot></table>)",
      caption, rows,
      error_row("RMS", s.rms_x_m, s.rms_y_m, s.rms_r_m, s.has_theta ? s.rms_theta_rad : unknown),
      error_row("Mean (c.g.)", s.x_cg_m, s.y_cg_m, s.r_cg_m, s.has_theta ? s.theta_cg_rad : unknown),
      error_row("± s.e. of mean", s.se_x_m, s.se_y_m, s.se_r_m, s.has_theta ? s.se_theta_rad : unknown));
}

std::string parameter_row(const ParameterRow& p) {
  const int decimals = decimals_for(p.standard_error, six_digits(p.after));
  const double percent = 100 * (p.after / p.before - 1);
  const int percent_decimals = decimals_for(100 * p.standard_error / std::abs(p.before), 3);
  const bool has_change = std::isfinite(percent);
  return fmt::format(
      R"(<tr><th scope="row">{}</th><td>{}</td><td>{}</td><td>{}</td><td class="text">{}</td><td>{}</td></tr>
)",
      escape(p.name), fixed(p.before, decimals), fixed(p.after, decimals),
      std::isfinite(p.standard_error) ? "± " + fixed(p.standard_error, decimals) : "–",
      p.unit.empty() ? "–" : escape(p.unit),
      has_change ? (percent > 0 ? "+" : "") + fixed(percent, percent_decimals) + " %" : "–");
}

/// A figure of merit of the factor table.
struct Merit {
  std::string label;
  double shown_per_unit;
  int decimals;
  std::function<FigureOfMerit(const Phase&)> of;
};

using Component = double (*)(const EndPose&);

Merit rms_merit(const char* symbol, const char* direction, const char* unit, Ends Phase::*ends,
                Component component) {
  const bool angle = std::string_view(unit) == "rad";
  return {fmt::format(R"(RMS <var>{}</var>, {} <span class="unit">{}</span>)", symbol, direction, unit),
          angle ? 1.0 : 1e3, angle ? 4 : 1, [=](const Phase& phase) {
            std::vector<double> values;
            for (const EndPose& end : phase.*ends) values.push_back(component(end));
            return calibration::root_mean_square(values);
          }};
}

Merit distance_merit(const char* direction, ClusterSummary calibration::ExperimentSummary::*cluster) {
  return {fmt::format(R"(<var>r</var><sub>cg</sub>, {} <span class="unit">mm</span>)", direction), 1e3, 1,
          [=](const Phase& phase) {
            const ClusterSummary& c = phase.squares.*cluster;
            return FigureOfMerit{c.r_cg_m, c.se_r_m, c.runs};
          }};
}

std::vector<Merit> merits() {
  std::vector<Merit> out{
      {R"(<var>E</var><sub>max,syst</sub> <span class="unit">mm</span>)", 1, 1, largest_error_mm},
      distance_merit(in_words(Sense::cw), &calibration::ExperimentSummary::cw),
      distance_merit(in_words(Sense::ccw), &calibration::ExperimentSummary::ccw)};
  for (const auto& [name, ends] :
       {std::pair{in_words(Sense::cw), &Phase::cw}, std::pair{in_words(Sense::ccw), &Phase::ccw}}) {
    out.push_back(rms_merit("e<sub>x</sub>", name, "mm", ends, [](const EndPose& e) { return e.x_m; }));
    out.push_back(rms_merit("e<sub>y</sub>", name, "mm", ends, [](const EndPose& e) { return e.y_m; }));
    out.push_back(
        rms_merit("r", name, "mm", ends, [](const EndPose& e) { return std::hypot(e.x_m, e.y_m); }));
    out.push_back(
        rms_merit("e<sub>θ</sub>", name, "rad", ends, [](const EndPose& e) { return e.theta_rad; }));
  }
  return out;
}

std::string merit_row(const Merit& merit, const std::vector<SquarePhase>& squares) {
  std::string row = "<tr><th scope=\"row\">" + merit.label + "</th>";
  const FigureOfMerit first = merit.of(*squares.front().phase);
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const FigureOfMerit e = merit.of(*squares[i].phase);
    row += cell(
        with_error(e.value * merit.shown_per_unit, e.standard_error * merit.shown_per_unit, merit.decimals));
    if (i > 0) row += cell(describe(improvement(first, e)));
  }
  return row + "</tr>\n";
}

std::string phase_row(const Phase& phase) {
  std::string row = "<tr><th scope=\"row\">" + escape(capitalised(phase.title)) + "</th>";
  for (const LoadedValue& loaded : phase.loaded)
    row += cell(with_error(loaded.value, loaded.standard_error, six_digits(loaded.value)));
  if (!has_squares(phase)) return row + cell("–") + "</tr>\n";
  const FigureOfMerit error = largest_error_mm(phase);
  return row + cell(with_error(error.value, error.standard_error, 1)) + "</tr>\n";
}

std::string pair_of_cells(double before, double after) {
  const auto shown = [](double value) {
    return std::isfinite(value) ? fixed(1000 * value, 1) : std::string("–");
  };
  return cell(shown(before)) + cell(shown(after));
}

std::string drive_row(const std::string& name, const DriveFigures& before, const DriveFigures& after) {
  return "<tr><th scope=\"row\">" + escape(name) + "</th>" + pair_of_cells(before.end_m, after.end_m) +
         pair_of_cells(std::abs(before.heading_rad), std::abs(after.heading_rad)) +
         pair_of_cells(before.path_rms_m, after.path_rms_m) + "</tr>\n";
}

}  // namespace

Section drive_comparison(const ReportInput& input) {
  Section out{"drives", "Drives", ""};
  if (!input.comparison) return out;
  const DriveComparison& drives = *input.comparison;
  std::string rows;
  for (const DriveRow& drive : drives.drives) rows += drive_row(drive.name, drive.before, drive.after);
  const std::string first = escape(input.phases.front().title), last = escape(input.phases.back().title);
  out.body = fmt::format(
      R"(<p class="sentence">{}</p>
<table><caption>Odometry less ground truth</caption><thead>
<tr><th></th><th colspan="2" scope="colgroup">End <span class="unit">mm</span></th>
<th colspan="2" scope="colgroup">Heading <span class="unit">mrad</span></th>
<th colspan="2" scope="colgroup">Path, RMS <span class="unit">mm</span></th></tr>
<tr><th scope="col">Drive</th><th scope="col">{}</th><th scope="col">{}</th><th scope="col">{}</th><th scope="col">{}</th>
<th scope="col">{}</th><th scope="col">{}</th></tr></thead>
<tbody>{}</tbody><tfoot>{}</tfoot></table>)",
      escape(drives.verdict), first, last, first, last, first, last, rows,
      drive_row("RMS", drives.before, drives.after));
  return out;
}

Section parameter_table(const ReportInput& input) {
  Section out{"parameters", "Parameters", ""};
  std::string rows;
  for (const auto& p : input.parameters) rows += parameter_row(p);
  if (rows.empty()) return out;
  const char* const after = input.not_loaded ? "Found, not loaded" : "After";
  if (!input.reason.empty()) out.body = "<p>" + escape(input.reason) + "</p>\n";
  out.body += fmt::format(
      R"(<div class="scroll"><table class="wide"><caption>The standard error is that of the new value on another day.</caption>
<thead><tr><th scope="col">Parameter</th><th scope="col">Before</th><th scope="col">{}</th>
<th scope="col">Standard error</th><th scope="col" class="text">Unit</th><th scope="col">Change</th></tr></thead><tbody>{}</tbody></table></div>)",
      after, rows);
  return out;
}

Section history(const ReportInput& input) {
  Section out{"history", "History", ""};
  const bool complete = std::all_of(input.phases.begin(), input.phases.end(), [&](const Phase& phase) {
    return !phase.loaded.empty() && phase.loaded.size() == input.parameters.size();
  });
  if (input.phases.size() < 3 || !complete) return out;
  std::string head, rows;
  for (const ParameterRow& p : input.parameters)
    head += "<th scope=\"col\">" + escape(p.name) +
            (p.unit.empty() ? "" : R"( <span class="unit">)" + escape(p.unit) + "</span>") + "</th>";
  for (const Phase& phase : input.phases) rows += phase_row(phase);
  out.body = fmt::format(
      R"(<div class="scroll"><table class="wide"><caption>What was loaded in the robot in each phase, with the standard errors of the calibration that found it, and what was left of the square’s error.</caption>
<thead><tr><th scope="col">Phase</th>{}<th scope="col"><var>E</var><sub>max,syst</sub> <span class="unit">mm</span></th></tr></thead><tbody>{}</tbody></table></div>)",
      head, rows);
  return out;
}

Section factor_table(const ReportInput& input) {
  Section out{"improvement", "Improvement", ""};
  const auto squares = square_phases(input);
  if (squares.size() < 2) return out;
  std::string head, rows;
  for (std::size_t i = 0; i < squares.size(); ++i) {
    head += "<th scope=\"col\">" + escape(capitalised(squares[i].phase->title)) + "</th>";
    if (i > 0) head += "<th scope=\"col\">Factor</th>";
  }
  for (const Merit& merit : merits()) rows += merit_row(merit, squares);
  out.body = fmt::format(
      R"(<div class="scroll"><table class="wide"><caption>Factor: the first phase over the phase to its left.</caption>
<thead><tr><th scope="col">Quantity</th>{}</tr></thead><tbody>{}</tbody></table></div>)",
      head, rows);
  return out;
}

Section rms_tables(const ReportInput& input) {
  Section out{"tables", "End errors, run by run", ""};
  for (const auto& s : square_phases(input)) {
    const std::string title = escape(capitalised(s.phase->title));
    out.body += "<div class=\"tables\">" +
                error_table(title + ", " + in_words(Sense::cw), s.phase->cw, s.phase->squares.cw) +
                error_table(title + ", " + in_words(Sense::ccw), s.phase->ccw, s.phase->squares.ccw) +
                "</div>\n";
  }
  return out;
}

}  // namespace astro::report
