#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/base/file_problem.hpp"
#include "host/base/text/sense.hpp"
#include "host/report/assets.hpp"
#include "host/report/html.hpp"
#include "tests/host/report/example_input.hpp"
#include "tests/support/base/remarks.hpp"

namespace astro::report {
namespace {

using testing::HasSubstr;
using testing::Not;

/// The page without the plotting library, which is not ours.
std::string our_part(const std::string& html) {
  const auto at = html.find(assets::library_js());
  EXPECT_NE(at, std::string::npos);
  return html.substr(0, at) + html.substr(at + assets::library_js().size());
}

nlohmann::json data_of(const std::string& html) {
  const std::string open = R"(id="report-data">)";
  const auto begin = html.find(open) + open.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

/// Cells of the row that starts with `label` in the table whose caption is `caption`.
std::vector<std::string> row_of(const std::string& html, const std::string& caption,
                                const std::string& label) {
  const auto table = html.find("<caption>" + caption);
  if (table == std::string::npos) return {"no such table"};
  const std::string part = html.substr(table, html.find("</table>", table) - table);
  const auto row = part.find("<th scope=\"row\">" + label);
  if (row == std::string::npos) return {"no such row"};
  const std::string cells = part.substr(row, part.find("</tr>", row) - row);
  std::vector<std::string> out;
  for (auto at = cells.find("<td"); at != cells.npos; at = cells.find("<td", at + 1)) {
    const auto begin = cells.find('>', at) + 1;
    out.push_back(cells.substr(begin, cells.find("</td>", begin) - begin));
  }
  return out;
}

TEST(Report, PrintsTheFiguresOfTheThesissTables) {
  const std::string html = our_part(render_html(thesis_input()));
  using Row = std::vector<std::string>;
  EXPECT_EQ(row_of(html, "Before, clockwise", "1"), (Row{"−271.98", "−385.85", "472.07", "0.1874"}));
  EXPECT_EQ(row_of(html, "Before, clockwise", "RMS"), (Row{"229.98", "276.09", "359.33", "0.1539"}));
  EXPECT_EQ(row_of(html, "Before, clockwise", "Mean"), (Row{"−223.33", "−260.00", "342.75", "0.1512"}));
  EXPECT_EQ(row_of(html, "Before, counter-clockwise", "RMS"), (Row{"318.47", "257.76", "409.71", "0.1759"}));
  EXPECT_EQ(row_of(html, "Before, counter-clockwise", "Mean"),
            (Row{"314.05", "−255.71", "404.99", "0.1747"}));
  EXPECT_EQ(row_of(html, "After, clockwise", "RMS"), (Row{"60.39", "32.14", "68.41", "0.0224"}));
  EXPECT_EQ(row_of(html, "After, counter-clockwise", "Mean")[2], "89.96");
}

TEST(Report, ShowsParametersWithTheirErrorAndRelativeChange) {
  const std::string html = our_part(render_html(thesis_input()));
  EXPECT_THAT(html, HasSubstr(R"(<th scope="row">c_R</th><td>1.00000</td><td>1.00208</td><td>± 0.00012</td>)"
                              R"(<td class="text">–</td><td>+0.208 %</td>)"));
  EXPECT_THAT(html, HasSubstr(R"(<th scope="row">b</th><td>0.2900</td><td>0.2886</td><td>± 0.0011</td>)"
                              R"(<td class="text">m</td><td>−0.48 %</td>)"));
}

TEST(Report, ShowsTheHistoryOfSeveralRounds) {
  ReportInput input = thesis_input(1);
  input.phases[0].loaded = {{1}, {1}, {0.29}};
  input.phases[1].loaded = {{1.0020770, 0.00012}, {0.997923, 0.00012}, {0.28861, 0.0011}};
  EXPECT_THAT(our_part(render_html(input)), Not(HasSubstr("id=\"history\"")))
      << "two phases are the parameter table";
  input.phases.push_back(input.phases[1]);
  input.phases[2].title = "after-2";
  input.phases[2].loaded[0] = {1.0021, std::nan("")};
  const std::string html = our_part(render_html(input));
  using Row = std::vector<std::string>;
  const std::string caption = "What was loaded in the robot";
  EXPECT_EQ(row_of(html, caption, "Before"), (Row{"1.00000", "1.00000", "0.290000", "405 ± 31"}));
  EXPECT_EQ(row_of(html, caption, "After"),
            (Row{"1.00208 ± 0.00012", "0.99792 ± 0.00012", "0.2886 ± 0.0011", "90 ± 18"}));
  EXPECT_EQ(row_of(html, caption, "After-2")[0], "1.00210");
}

TEST(Report, LeadsWithTheImprovementAndItsSignificance) {
  const std::string html = our_part(render_html(thesis_input()));
  EXPECT_THAT(html, HasSubstr("<strong>4.5 times smaller</strong>"));
  EXPECT_THAT(html, HasSubstr("is significant at the 5 % level"));
}

TEST(Report, EscapesEveryTextOfItsInput) {
  const std::string evil = R"(</script><script>alert("1")</script><img src=x onerror='a&b'>{{data}})";
  ReportInput input = thesis_input(1);
  input.title = input.method = evil;
  input.notes = {evil};
  input.description = {{evil, evil}};
  for (auto& p : input.parameters) p.name = p.unit = evil;
  for (auto& phase : input.phases) {
    phase.title = evil;
    for (auto& run : phase.runs) {
      run.info.kind = run.info.robot_name = run.info.robot_id = run.info.board = run.info.firmware = evil;
      run.info.started_at = run.info.truth_source = run.info.truth_clock = evil;
      run.warning = Remark{evil};
      run.info.parameters = {{evil, 1.0}};
    }
  }
  const std::string html = render_html(input);
  EXPECT_THAT(our_part(html), Not(HasSubstr("<script>alert")));
  EXPECT_THAT(our_part(html), Not(HasSubstr("<img")));
  EXPECT_THAT(our_part(html), HasSubstr("&lt;/script&gt;"));
  EXPECT_EQ(data_of(html)["phases"][0], evil);
}

TEST(Report, SurvivesTextThatIsNotUtf8) {
  ReportInput input = thesis_input(1);
  input.phases[0].title = "before \xff\xfe";
  EXPECT_EQ(data_of(render_html(input))["phases"][0], "before \uFFFD\uFFFD");
}

TEST(Report, GivesEqualBytesForEqualInput) {
  EXPECT_EQ(render_html(thesis_input()), render_html(thesis_input()));
}

TEST(Report, LoadsNothingFromAnywhere) {
  const std::string html = render_html(thesis_input(1));
  EXPECT_THAT(our_part(html), Not(HasSubstr("http://")));
  EXPECT_THAT(our_part(html), Not(HasSubstr("https://")));
  for (const char* loader : {"<link", "<img", "<iframe", "<script src", " src=", "@import", "url("}) {
    EXPECT_THAT(our_part(html), Not(HasSubstr(loader)));
  }
  EXPECT_THAT(html, HasSubstr("Content-Security-Policy\" content=\"default-src 'none'"));
  EXPECT_THAT(std::string(assets::library_js()), Not(HasSubstr("</script")));
}

TEST(Report, KeepsTheLicenceOfTheLibrary) {
  EXPECT_THAT(render_html(thesis_input(1)), HasSubstr("MIT license"));
}

TEST(Report, OfTwentyLongRunsStaysBelowFiveMegabytes) {
  ReportInput input = thesis_input(1);
  for (auto& phase : input.phases) {
    phase.runs.clear();
    for (int i = 1; i <= 10; ++i) phase.runs.push_back(example_run("square", Sense::cw, i, 600, 4e-3, 1));
  }
  EXPECT_LT(render_html(input).size(), 5'000'000U);
}

TEST(Report, LeavesOutWhatWasNotMeasured) {
  ReportInput input;
  input.title = "Nothing but a line";
  input.phases = {
      {.title = "before", .runs = {example_run("line", {}, 1, 5, 0, 1)}, .squares = {}, .cw = {}, .ccw = {}}};
  const std::string html = our_part(render_html(input));
  EXPECT_THAT(html, Not(HasSubstr("id=\"result\"")));
  EXPECT_THAT(html, Not(HasSubstr("data-figure=\"scatter\"")));
  EXPECT_THAT(html, HasSubstr("data-figure=\"path\""));
  EXPECT_NO_THROW(render_html({}));
}

TEST(Report, PutsRunsThatWereDrivenAlikeUnderOneHeading) {
  ReportInput input = thesis_input(2);
  std::reverse(input.phases[1].runs.begin(), input.phases[1].runs.end());  // recorded in another order
  const std::string html = our_part(render_html(input));
  std::size_t at = 0;
  for (const char* heading : {"Squares of 3 m, clockwise", "Squares of 3 m, counter-clockwise",
                              "Circles of 1.2 m radius, clockwise",
                              "Circles of 1.2 m radius, counter-clockwise", "Straight lines of 3 m"}) {
    const auto next = html.find(std::string("<h3>") + heading + "</h3>");
    ASSERT_NE(next, std::string::npos) << heading;
    EXPECT_GT(next, at) << heading << " stands too early";
    at = next;
  }
  const auto group = data_of(html)["groups"][0];
  for (const int phase : {0, 1}) {
    EXPECT_EQ(group["phases"][phase][0]["number"], 1);
    EXPECT_EQ(group["phases"][phase][1]["number"], 2);
  }
}

TEST(Report, ShowsADashForHeadingsThatWereNotMeasured) {
  ReportInput input = thesis_input(1);
  for (auto* ends : {&input.phases[0].cw, &input.phases[0].ccw}) {
    for (auto& end : *ends) end.theta_rad = std::nan("");
  }
  input.phases[0].squares = calibration::summarize(input.phases[0].cw, input.phases[0].ccw);
  const std::string html = our_part(render_html(input));
  EXPECT_EQ(row_of(html, "Before, clockwise", "RMS")[3], "–");
  EXPECT_EQ(row_of(html, "Before, clockwise", "1")[3], "–");
  EXPECT_THAT(html, Not(HasSubstr("<td>nan")));
}

TEST(Report, IsWrittenWholeOrNotAtAll) {
  const auto folder = std::filesystem::path(testing::TempDir()) / ("report-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  write_report(folder / "report.html", thesis_input(1));
  write_report(folder / "report.html", thesis_input(1));
  std::stringstream written;
  written << std::ifstream(folder / "report.html").rdbuf();
  EXPECT_EQ(written.str(), render_html(thesis_input(1)));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  std::filesystem::remove_all(folder);
}

TEST(Report, NamesTheFileThatCannotBeWritten) {
  EXPECT_THAT([] { write_report("/dev/null/report.html", thesis_input(1)); },
              support::ThrowsTelling(FileProblem::folder_not_made, "/dev/null"));
}

TEST(ReportTemplate, NeverLooksForPlaceholdersInsideValues) {
  EXPECT_EQ(fill("<{{a}}|{{b}}>", {{"a", "{{b}}"}, {"b", "{{"}}), "<{{b}}|{{>");
  EXPECT_THROW(fill("{{missing}}", {}), std::out_of_range);
}

}  // namespace
}  // namespace astro::report
