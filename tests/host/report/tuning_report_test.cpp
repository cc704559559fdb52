#include "host/report/tuning_report.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/host/report/browser.hpp"

namespace astro::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Two wheels on a line, a measured step and one that is only predicted.
TuningInput example() {
  TuningInput input;
  input.title = "Tuning of <ASTRO>";
  for (std::size_t side = 0; side < 2; ++side) {
    MotorFigure& motor = input.motors[side];
    motor.wheel = side == 0 ? "left" : "right";
    motor.fit = {{0.48, 12.18, 1.08}, {0.001, 0.01, 0.002}, 0.01, 0.9999, {}};
    for (int i = -40; i <= 40; ++i) {
      const double v = 0.01 * i, sense = i < 0 ? -1 : 1;
      if (i != 0) motor.fit.windows.push_back({0.48 * sense + 12.18 * v, sense, v, 0});
    }
    motor.breakaway_forward_V = 1.02;
    motor.breakaway_backward_V = std::nan("");
  }
  input.parameters = {{"kp", "Vs/m", 40, 32.2}, {"kS_left", "V", 0.9, 0.48, 0.001}};
  input.loop = {{"Designed", "bandwidth 7.9 Hz"}};
  for (const char* title : {"before", "with the new values"}) {
    StepFigure step;
    step.title = title;
    for (StepLines& lines : step.wheels) {
      for (int i = 0; i < 500; ++i) {
        lines.time_s.push_back(2e-3 * i);
        lines.set_point_mps.push_back(std::min(0.3, 1e-3 * i));
        lines.predicted_mps.push_back(0.98 * lines.set_point_mps.back());
        if (input.steps.empty()) lines.measured_mps.push_back(0.97 * lines.set_point_mps.back());
      }
    }
    input.steps.push_back(step);
  }
  input.description = {{"Robot", "<ASTRO>"}};
  input.notes = {"a note"};
  return input;
}

TEST(TuningReport, TextAndTablesAreCompleteAndEscaped) {
  const std::string html = render_tuning_html(example());
  EXPECT_THAT(html,
              AllOf(HasSubstr("Tuning of &lt;ASTRO&gt;"), HasSubstr("12.180 ± 0.010"), HasSubstr("kS_left"),
                    HasSubstr("Before, left, measured"), HasSubstr("With the new values, right, predicted"),
                    HasSubstr("bandwidth 7.9 Hz"), HasSubstr("a note")));
  EXPECT_THAT(html, Not(HasSubstr("With the new values, right, measured")));
  EXPECT_EQ(html, render_tuning_html(example()));
}

TEST(TuningReport, ABrowserDrawsEveryTrace) {
  if (!browser_is_installed()) GTEST_SKIP() << "chromium is not installed; ./dev setup installs it";
  const std::string dom = open_in_browser(render_tuning_html(example()));
  const auto figures = figures_of(dom);
  ASSERT_EQ(figures.size(), 2U + 2U * 2U);
  for (const auto& figure : figures) {
    SCOPED_TRACE(figure.kind + " phase " + figure.phase);
    EXPECT_TRUE(figure.drawn);
    EXPECT_FALSE(figure.failed);
    // Points, fit and breakaway; set point, and measured and predicted as speed and as error.
    EXPECT_EQ(figure.traces, figure.kind == "motor" ? 3 : figure.phase == "0" ? 5 : 3);
  }
  EXPECT_THAT(dom, Not(HasSubstr("data-error")));
}

}  // namespace
}  // namespace astro::report
