#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "host/report/comparison.hpp"
#include "host/report/groups.hpp"
#include "host/report/report.hpp"

/// The parts of the page in reading order. Text and tables are complete HTML; figures are empty frames
/// (<figure data-figure=...>) that web/report.js fills. A body without content is "" and the part is left
/// out.
namespace astro::report {

/// Phases beyond the fourth take the colours of the first again, as in web/report.js.
inline constexpr std::size_t kAccents = 4;

struct Section {
  std::string id, heading, body;
};

/// The whole page; `data` is what web/report.js draws from.
std::string render_page(const std::string& title, const std::vector<Section>& sections,
                        const nlohmann::json& data);

Section headline(const ReportInput& input);
Section scatter(const ReportInput& input);
Section run_figures(const ReportInput& input, const std::vector<RunGroup>& groups);
Section rms_tables(const ReportInput& input);
Section parameter_table(const ReportInput& input);
/// All phases in a row; only for three and more, as two are the parameter table.
Section history(const ReportInput& input);
Section factor_table(const ReportInput& input);
Section provenance(const ReportInput& input);

/// The phases with squares in both directions, and the index of each in the input.
struct SquarePhase {
  std::size_t index;
  const Phase* phase;
};
std::vector<SquarePhase> square_phases(const ReportInput& input);

/// E_max_syst of a phase in mm, with the number of runs of the direction that it comes from.
calibration::FigureOfMerit largest_error_mm(const Phase& phase);

}  // namespace astro::report
