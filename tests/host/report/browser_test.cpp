#include "tests/host/report/browser.hpp"

#include <gmock/gmock.h>

#include <map>

#include "host/report/assets.hpp"
#include "tests/host/report/example_input.hpp"

namespace astro::report {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::Pair;

class ReportInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (!browser_is_installed()) GTEST_SKIP() << "chromium is not installed; ./dev setup installs it";
  }
};

/// `html` with a script of the test's own at its end.
std::string with_script(std::string html, const std::string& script) {
  return html.insert(html.rfind("</body>"), "<script>" + script + "</script>");
}

/// Traces that a figure of thesis_input() must show: of a path the true line, the believed line and the end
/// error; of errors three strips for each of two phases; of a scatter circle, runs and mean each way; of residuals ahead, to the
/// left and heading, with both sets of factors.
int traces_of(const std::string& kind) {
  return kind == "path" ? 3 : kind == "merit" ? 2 : kind == "map" ? 1 : 6;
}

/// thesis_input() with groups of squares only: a browser takes seconds for each group.
ReportInput squares_only(int squares) {
  ReportInput input = thesis_input(squares);
  for (Phase& phase : input.phases)
    std::erase_if(phase.runs, [](const recording::Run& run) { return run.info.kind != "square"; });
  return input;
}

/// Walls as odometry shows them with the factors before and after, and what remains of each scan.
ScanFigures scan_figures() {
  ScanFigures scans;
  scans.drive = "before: square <cw> 1";
  for (int i = 0; i < 100; ++i) {
    scans.before.push_back({0.05 * i, 2 + 0.002 * i});
    scans.after.push_back({0.05 * i, 2});
    scans.residuals.push_back({0.4 * i, {0.002, -0.001, 0.004}, {0.0001, 0, 0.0002}});
  }
  return scans;
}

TEST_F(ReportInBrowser, DrawsEveryTraceOfEveryFigure) {
  ReportInput input = thesis_input();
  input.scans = scan_figures();
  const std::string dom = open_in_browser(render_html(input));
  std::map<std::string, int> kinds;
  for (const auto& f : figures_of(dom)) {
    SCOPED_TRACE(f.kind + " group " + f.group + " phase " + f.phase);
    ++kinds[f.kind];
    EXPECT_TRUE(f.drawn);
    EXPECT_FALSE(f.failed);
    EXPECT_EQ(f.traces, traces_of(f.kind));
    EXPECT_GE(f.strokes, f.traces);
  }
  // Per group of runs (square and circle both ways, line) a path per phase and the errors.
  EXPECT_THAT(kinds, testing::UnorderedElementsAre(Pair("merit", 1), Pair("scatter", 2), Pair("path", 5 * 2),
                                                   Pair("errors", 5), Pair("map", 2), Pair("residuals", 1)));
  EXPECT_THAT(dom, HasSubstr("square &lt;cw&gt; 1"));
  EXPECT_THAT(dom, HasSubstr("data-ready=\"true\""));
  EXPECT_THAT(dom, Not(HasSubstr("data-error")));
  EXPECT_THAT(dom, HasSubstr("<p id=\"problem\" role=\"alert\" hidden"));
}

TEST_F(ReportInBrowser, ShowsTheRunThatItsSelectorAsksFor) {
  const std::string choose_all = R"(
    const wait = setInterval(() => {
      if (document.body.dataset.ready !== 'true') return;
      clearInterval(wait);
      document.querySelector('[name="runs-0"][value="all"]').click();
    }, 50);)";
  const auto figures = figures_of(open_in_browser(with_script(render_html(squares_only(3)), choose_all)));
  ASSERT_FALSE(figures.empty());
  for (const auto& f : figures) {
    const int runs = f.group == "0" ? 3 : 1;
    EXPECT_EQ(f.traces, runs * traces_of(f.kind)) << f.kind << " group " << f.group << " phase " << f.phase;
  }
}

TEST_F(ReportInBrowser, DrawsPathsWithoutGroundTruthAndPhasesOfUnequalLength) {
  ReportInput input = squares_only(2);
  for (auto& run : input.phases[0].runs) run.truth.clear();
  input.phases[1].runs.resize(1);
  const auto figures = figures_of(open_in_browser(render_html(input)));
  ASSERT_FALSE(figures.empty());
  for (const auto& f : figures) {
    SCOPED_TRACE(f.kind + " group " + f.group + " phase " + f.phase);
    EXPECT_TRUE(f.drawn);
    const int untracked = f.kind == "path" && f.phase == "0" ? 1 : 0;
    const int of_one_phase = f.kind == "errors" ? 3 : 0;
    EXPECT_EQ(f.traces, untracked + of_one_phase > 0 ? untracked + of_one_phase : traces_of(f.kind));
  }
}

TEST_F(ReportInBrowser, PrintsEachGroupOfRunsOnOnePage) {
  // Five groups on a page each, and at most three pages of the rest: nothing is left half empty by a figure
  // that would not fit any more.
  const int pages = pages_on_paper(render_html(thesis_input()));
  EXPECT_GE(pages, 6);
  EXPECT_LE(pages, 5 + 3);
}

TEST_F(ReportInBrowser, SaysSoWhereAFigureCannotBeDrawn) {
  std::string html = render_html(thesis_input(1));
  html.replace(html.find(assets::library_js()), assets::library_js().size(), "");
  const std::string dom = open_in_browser(html);
  EXPECT_THAT(dom, HasSubstr("A figure could not be drawn"));
  EXPECT_THAT(dom, Not(HasSubstr("role=\"alert\" hidden")));
  for (const auto& f : figures_of(dom)) EXPECT_TRUE(f.failed && !f.drawn);
}

TEST_F(ReportInBrowser, RunsNoScriptFromItsInput) {
  ReportInput input = squares_only(1);
  const std::string evil =
      R"(<script>document.body.dataset.pwned=1</script><img src=x onerror="document.body.dataset.pwned=1"><a href="https://example.invalid">x</a>)";
  input.title = input.phases[0].title = input.phases[1].title = evil;
  for (auto& phase : input.phases) {
    for (auto& run : phase.runs) run.info.kind = run.info.robot_name = evil;
  }
  const std::string dom = open_in_browser(render_html(input));
  EXPECT_THAT(dom, HasSubstr("data-ready=\"true\""));
  EXPECT_THAT(dom, Not(HasSubstr("data-pwned=\"")));
  EXPECT_THAT(dom, Not(HasSubstr("xlink:href=\"https")));
  EXPECT_THAT(dom, Not(HasSubstr("<a href=\"https")));
}

}  // namespace
}  // namespace astro::report
