#include "host/report/sections/report.hpp"

#include <nlohmann/json.hpp>

#include "host/report/page/page.hpp"
#include "host/report/sections/drives.hpp"
#include "host/report/sections/figures.hpp"
#include "host/report/sections/history.hpp"
#include "host/report/sections/provenance.hpp"
#include "host/report/sections/run_figures.hpp"
#include "host/report/sections/summary.hpp"
#include "host/report/sections/tables.hpp"

namespace astro::report {

std::string render_html(const ReportInput& input) {
  const auto groups = group_runs(input.phases);
  return render_page(
      input.title,
      {headline(input), drive_comparison(input), parameter_table(input), history(input), scatter(input),
       factor_table(input), rms_tables(input), run_figures(input, groups), provenance(input)},
      figure_data(input.phases, groups));
}

void write_report(const std::filesystem::path& path, const ReportInput& input) {
  write_page(path, render_html(input));
}

}  // namespace astro::report
