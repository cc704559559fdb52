#include "host/experiment/drive/doubtful_run.hpp"

#include <fmt/format.h>

#include <cmath>

#include "host/calibration/end_poses/line_scale.hpp"
#include "host/calibration/end_poses/odd_run.hpp"
#include "host/experiment/analysis/squares.hpp"

namespace astro::experiment {
namespace {

using calibration::LineEnd;

/// The squares of one direction, and their indices among all runs.
struct Direction {
  std::vector<calibration::SquareEnd> ends;
  std::vector<std::size_t> at;
};

Direction squares_among(std::span<const RunSpec> specs, std::span<const recording::Run> runs, Sense sense) {
  Direction direction;
  for (std::size_t i = 0; i < specs.size(); ++i) {
    if (specs[i].kind != "square" || specs[i].direction != sense) continue;
    const calibration::SquareEnd end = square_end(runs[i]);
    if (!std::isfinite(end.measured.x_m)) continue;
    direction.ends.push_back(end);
    direction.at.push_back(i);
  }
  return direction;
}

void add_squares(std::span<const RunSpec> specs, std::span<const recording::Run> runs,
                 std::vector<DoubtfulRun>& list) {
  const Direction cw = squares_among(specs, runs, Sense::cw), ccw = squares_among(specs, runs, Sense::ccw);
  if (cw.ends.empty() && ccw.ends.empty()) return;
  const recording::RunInfo& info = runs[cw.at.empty() ? ccw.at.front() : cw.at.front()].info;
  for (const calibration::OddRun& odd :
       calibration::odd_runs(cw.ends, ccw.ends, {info.size_m, loaded_factors(info)})) {
    const RunSpec& spec = specs[(odd.sense == Sense::cw ? cw : ccw).at[odd.index]];
    list.push_back({spec, spec.title() + ": " + described(odd)});
  }
}

/// The scale that the other lines give, if at least two of them agree, because two cannot both be wrong in
/// the same way. Otherwise the loaded scale.
double scale_without(std::span<const LineEnd> lines, std::size_t index) {
  std::vector<LineEnd> others(lines.begin(), lines.end());
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(index));
  if (others.size() < 2 || is_odd(others[0], others[1].scale())) return lines[index].loaded_scale;
  return (others[0].scale() + others[1].scale()) / 2;
}

/// "; x = 3000 mm would fit", if another decimal point or sign makes it fit.
std::string likely_meant(const LineEnd& line, double scale) {
  for (const double factor : {-1.0, 1e-3, 1e-2, 1e-1, 1e1, 1e2, 1e3}) {
    LineEnd meant = line;
    meant.x_m *= factor;
    if (meant.x_m > 0 && !is_odd(meant, scale))
      return fmt::format("; x = {:.5g} mm would fit", 1000 * meant.x_m);
  }
  return "";
}

void add_lines(std::span<const RunSpec> specs, std::span<const recording::Run> runs,
               std::vector<DoubtfulRun>& list) {
  std::vector<LineEnd> lines;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (const auto line = line_of(runs[i])) {
      lines.push_back(*line);
      at.push_back(i);
    }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const double scale = scale_without(lines, i);
    if (!is_odd(lines[i], scale)) continue;
    list.push_back(
        {specs[at[i]],
         fmt::format("{}: x = {:.5g} mm, y = {:.5g} mm, and about x = {:.5g} mm is to be expected{}",
                     specs[at[i]].title(), 1000 * lines[i].x_m, 1000 * lines[i].y_m,
                     1000 * lines[i].driven_m * scale / lines[i].loaded_scale,
                     likely_meant(lines[i], scale))});
  }
}

}  // namespace

std::vector<DoubtfulRun> doubtful_runs(std::span<const RunSpec> specs, std::span<const recording::Run> runs) {
  std::vector<DoubtfulRun> list;
  add_squares(specs, runs, list);
  add_lines(specs, runs, list);
  return list;
}

}  // namespace astro::experiment
