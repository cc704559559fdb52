#include "host/report/report.hpp"

#include <fmt/core.h>

#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "host/recording/run_metadata.hpp"
#include "host/recording/slip_remark.hpp"
#include "host/report/figures.hpp"
#include "host/report/html.hpp"
#include "host/report/numbers.hpp"
#include "host/report/page.hpp"
#include "host/report/scans.hpp"
#include "host/report/squares.hpp"
#include "host/report/tables.hpp"

namespace astro::report {

namespace {

using recording::Run;

/// A description of the runs of a phase; different values are listed side by side.
struct Fact {
  std::string label;
  std::function<std::string(const Run&)> of;
};

std::string answers(const Phase& phase, const Fact& fact) {
  std::set<std::string> seen;
  for (const auto& run : phase.runs) seen.insert(fact.of(run));
  seen.erase("");
  std::string out;
  for (const auto& answer : seen) out += (out.empty() ? "" : ", ") + escape(answer);
  return out;
}

std::vector<Fact> facts_of(const ReportInput& input) {
  std::vector<Fact> facts{
      {"Robot", [](const Run& run) { return run.info.robot_name; }},
      {"Robot id", [](const Run& run) { return run.info.robot_id; }},
      {"Board", [](const Run& run) { return run.info.board; }},
      {"Firmware", [](const Run& run) { return run.info.firmware; }},
      {"Ground truth", [](const Run& run) { return run.info.truth_source; }},
      {"Clock of the ground truth", [](const Run& run) { return run.info.truth_clock; }},
      {"Warnings", [](const Run& run) { return run.warning ? run.warning->sentence : ""; }},
      {"Turns without wheels, by the gyro",
       [](const Run& run) {
         const auto slips = recording::slip_remark(run, recording::run_name(run.info));
         return slips ? slips->sentence : "";
       }},
      {"Speed", [](const Run& run) {
         return run.info.speed_mps > 0 ? fmt::format("{:g} m/s", run.info.speed_mps) : "";
       }}};
  for (const auto& p : input.parameters) {
    facts.push_back({"Loaded " + p.name, [name = p.name](const Run& run) {
                       const auto found = run.info.parameters.find(name);
                       return found == run.info.parameters.end()
                                  ? ""
                                  : fixed(found->second, six_digits(found->second));
                     }});
  }
  return facts;
}

std::string dates(const Phase& phase) {
  std::set<std::string> starts;  // ISO 8601 in UTC sorts as text
  for (const auto& run : phase.runs) starts.insert(run.info.started_at);
  starts.erase("");
  if (starts.empty()) return "";
  const std::string first = escape(*starts.begin());
  return starts.size() == 1 ? first : first + " to " + escape(*starts.rbegin());
}

std::string fact_row(const std::string& label, const std::vector<std::string>& cells) {
  bool any = false;
  std::string out = "<tr><th scope=\"row\">" + escape(label) + "</th>";
  for (const auto& cell : cells) {
    out += "<td class=\"text\">" + (cell.empty() ? "–" : cell) + "</td>";
    any |= !cell.empty();
  }
  return any ? out + "</tr>\n" : "";
}

std::string facts_table(const ReportInput& input) {
  std::string head, rows;
  std::vector<std::string> counts, driven;
  for (const auto& phase : input.phases) {
    head += "<th scope=\"col\" class=\"text\">" + escape(capitalised(phase.title)) + "</th>";
    counts.push_back(phase.runs.empty() ? "" : std::to_string(phase.runs.size()));
    driven.push_back(dates(phase));
  }
  rows = fact_row("Recorded runs", counts) + fact_row("Driven", driven);
  for (const auto& fact : facts_of(input)) {
    std::vector<std::string> cells;
    for (const auto& phase : input.phases) cells.push_back(answers(phase, fact));
    rows += fact_row(fact.label, cells);
  }
  if (rows.empty()) return "";
  return R"(<div class="scroll"><table class="wide facts"><caption>From the recordings</caption><thead><tr><td></td>)" +
         head + "</tr></thead><tbody>" + rows + "</tbody></table></div>";
}

std::string paragraphs(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const auto end = text.find("\n\n");
    out += "<p>" + escape(text.substr(0, end)) + "</p>\n";
    text.remove_prefix(end == text.npos ? text.size() : end + 2);
  }
  return out;
}

constexpr const char* kDefinitions = R"(<h3>How the figures are computed</h3>
<dl class="formulas">
<dt>Error of a run</dt><dd>(<var>e<sub>x</sub></var>, <var>e<sub>y</sub></var>, <var>e<sub>θ</sub></var>) = ground truth − odometry at its end, in the frame of the run’s start: x forward, y left, θ counter-clockwise; <var>r</var> = √(<var>e<sub>x</sub></var>² + <var>e<sub>y</sub></var>²)</dd>
<dt>Centre of gravity</dt><dd><var>x</var><sub>cg</sub>, <var>y</var><sub>cg</sub>: means over the runs of one direction; <var>r</var><sub>cg</sub> = √(<var>x</var><sub>cg</sub>² + <var>y</var><sub>cg</sub>²)</dd>
<dt>Largest systematic error</dt><dd><var>E</var><sub>max,syst</sub> = max(<var>r</var><sub>cg,cw</sub>, <var>r</var><sub>cg,ccw</sub>) (Borenstein and Feng). As the larger of two uncertain distances it reads somewhat high when it is near its standard error.</dd>
<dt>RMS</dt><dd>√(Σ<var>e</var>² / <var>n</var>)</dd>
<dt>Standard error of a mean</dt><dd><var>s</var> / √<var>n</var>, <var>s</var> with <var>n</var> − 1; of <var>r</var><sub>cg</sub>: √(<var>s</var><sub>x</sub>² + <var>s</var><sub>y</sub>²) / √<var>n</var>, the rms distance of the measured centre from the true one; of an RMS: to first order</dd>
<dt>Improvement factor</dt><dd>before / after; ± to first order; the 95 % interval by Fieller’s theorem with Student’s <var>t</var> for the smaller number of runs less one. “Significant” means: the difference is larger than that <var>t</var> times its standard error.</dd>
</dl>)";

/// Where the figures come from: robot, recordings, method, definitions and notes.
Section provenance(const ReportInput& input) {
  std::string body;
  if (!input.description.empty()) {
    body += "<dl class=\"description\">";
    for (const auto& d : input.description)
      body += "<dt>" + escape(d.name) + "</dt><dd>" + escape(d.value) + "</dd>\n";
    body += "</dl>";
  }
  body += facts_table(input);
  if (!input.method.empty()) body += "<h3>How the parameters were found</h3>" + paragraphs(input.method);
  body += kDefinitions;
  if (!input.notes.empty()) {
    body += "<h3>Notes</h3><ul>";
    for (const auto& note : input.notes) body += "<li>" + escape(note) + "</li>\n";
    body += "</ul>";
  }
  return {"provenance", "Provenance and method", body};
}

}  // namespace

std::string render_html(const ReportInput& input) {
  const auto groups = group_runs(input.phases);
  nlohmann::json data = figure_data(input.phases, groups);
  data["scans"] = scan_data(input);
  return render_page(
      input.title,
      {parameter_table(input), headline(input), drive_comparison(input), scan_section(input), history(input),
       scatter(input), factor_table(input), rms_tables(input), run_figures(input, groups), provenance(input)},
      data);
}

void write_report(const std::filesystem::path& path, const ReportInput& input) {
  write_page(path, render_html(input));
}

}  // namespace astro::report
