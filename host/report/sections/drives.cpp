#include "host/report/sections/drives.hpp"

#include <fmt/core.h>

#include <cmath>

#include "host/report/page/html.hpp"
#include "host/report/page/numbers.hpp"

namespace astro::report {
namespace {

std::string pair_of_cells(double before, double after) {
  const auto cell = [](double value) {
    return "<td>" + (std::isfinite(value) ? fixed(1000 * value, 1) : std::string("–")) + "</td>";
  };
  return cell(before) + cell(after);
}

std::string row(const std::string& name, const DriveFigures& before, const DriveFigures& after) {
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
  for (const DriveRow& drive : drives.drives) rows += row(drive.name, drive.before, drive.after);
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
      row("RMS", drives.before, drives.after));
  return out;
}

}  // namespace astro::report
