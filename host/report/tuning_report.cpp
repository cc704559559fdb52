#include "host/report/tuning_report.hpp"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/report/html.hpp"
#include "host/report/numbers.hpp"
#include "host/report/page.hpp"
#include "host/report/tables.hpp"

namespace astro::report {
namespace {

using nlohmann::json;

json rounded(const std::vector<double>& values, double step) {
  json list = json::array();
  for (const double value : values) list.push_back(std::round(value / step) * step);
  return list;
}

json motor_json(const MotorFigure& motor) {
  std::vector<double> voltage, acceleration, speed;
  for (const auto& window : motor.fit.windows) {
    voltage.push_back(window.voltage_V);
    acceleration.push_back(window.acceleration_mps2);
    speed.push_back(window.speed_mps);
  }
  const auto& model = motor.fit.model;
  return {{"kS", model.kS},
          {"kV", model.kV},
          {"kA", model.kA},
          {"breakaway", {motor.breakaway_forward_V, -motor.breakaway_backward_V}},
          {"V", rounded(voltage, 1e-4)},
          {"a", rounded(acceleration, 1e-4)},
          {"v", rounded(speed, 1e-5)}};
}

json lines_json(const StepLines& lines) {
  return {{"t", rounded(lines.time_s, 1e-4)},
          {"goal", rounded(lines.set_point_mps, 1e-5)},
          {"measured", rounded(lines.measured_mps, 1e-5)},
          {"predicted", rounded(lines.predicted_mps, 1e-5)}};
}

json data_of(const TuningInput& input) {
  json motors = json::array(), steps = json::array(), phases = json::array();
  for (const MotorFigure& motor : input.motors) motors.push_back(motor_json(motor));
  for (const StepFigure& step : input.steps) {
    phases.push_back(step.title);
    steps.push_back({lines_json(step.wheels[0]), lines_json(step.wheels[1])});
  }
  return {{"phases", phases},
          {"clusters", json::array()},
          {"groups", json::array()},
          {"motors", motors},
          {"steps", steps}};
}

std::string cell(double value, double error) {
  return fmt::format("<td>{}</td>", with_error(value, error, 3));
}

std::string motor_row(const MotorFigure& motor) {
  const auto& [model, error, residual_V, r_squared, windows] = motor.fit;
  const double tau_ms = 1e3 * model.time_constant_s();
  const double tau_error = tau_ms * std::hypot(error.kA / model.kA, error.kV / model.kV);
  return fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}{}<td>{} / {}</td><td>{}</td></tr>\n",
                     escape(capitalised(motor.wheel)), cell(model.kS, error.kS), cell(model.kV, error.kV),
                     cell(model.kA, error.kA), cell(tau_ms, tau_error), fixed(motor.breakaway_forward_V, 2),
                     fixed(motor.breakaway_backward_V, 2), fixed(1e3 * residual_V, 0));
}

std::string motor_figure(const MotorFigure& motor, std::size_t index) {
  const auto& model = motor.fit.model;
  return fmt::format(
      R"(<figure data-figure="motor" data-wheel="{}"><figcaption>{} wheel</figcaption>
<div class="plot" role="img" aria-label="Speed over voltage: {} V to keep turning, {} V for each metre per second"></div></figure>)",
      index, escape(capitalised(motor.wheel)), fixed(model.kS, 2), fixed(model.kV, 2));
}

Section motors(const TuningInput& input) {
  Section out{"motors", "What voltage does to the wheels", ""};
  std::string rows, figures;
  for (std::size_t i = 0; i < 2; ++i) {
    rows += motor_row(input.motors[i]);
    figures += motor_figure(input.motors[i], i);
  }
  out.body =
      R"(<p><var>V</var> = <var>k</var><sub>S</sub> sign(<var>v</var>) + <var>k</var><sub>V</sub> <var>v</var> +
<var>k</var><sub>A</sub> d<var>v</var>/d<var>t</var>, fitted to every window in which the wheel turned one way and was
driven; ± is one standard error. A wheel that stands breaks away at a higher voltage than it needs to keep turning.</p>
<div class="scroll"><table><thead><tr><th scope="col">Wheel</th>
<th scope="col"><var>k</var><sub>S</sub> <span class="unit">V</span></th>
<th scope="col"><var>k</var><sub>V</sub> <span class="unit">V s/m</span></th>
<th scope="col"><var>k</var><sub>A</sub> <span class="unit">V s²/m</span></th>
<th scope="col">Time constant <span class="unit">ms</span></th>
<th scope="col">Breaks away + / − <span class="unit">V</span></th>
<th scope="col">Residual <span class="unit">mV rms</span></th></tr></thead><tbody>)" +
      rows + "</tbody></table></div>\n<div class=\"panels\">" + figures + "</div>";
  return out;
}

Section gains(const TuningInput& input) {
  ReportInput table;
  table.parameters = input.parameters;
  Section out{"gains", "Feed-forward and gains", parameter_table(table).body};
  out.body += "<dl>";
  for (const auto& [name, value] : input.loop)
    out.body += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(value));
  out.body += "</dl>";
  return out;
}

std::string step_row(const std::string& what, const motor::StepFigures& figures) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     escape(capitalised(what)), fixed(1e3 * figures.rise_s, 0),
                     fixed(100 * figures.overshoot, 1), fixed(1e3 * figures.worst_error_mps, 1),
                     fixed(1e3 * figures.rms_error_mps, 1));
}

Section steps(const TuningInput& input) {
  Section out{"steps", "Steps of speed", ""};
  std::string rows, figures;
  for (std::size_t phase = 0; phase < input.steps.size(); ++phase) {
    const StepFigure& step = input.steps[phase];
    figures += "<div class=\"panels\">";
    for (std::size_t wheel = 0; wheel < 2; ++wheel) {
      const StepLines& lines = step.wheels[wheel];
      const std::string what = step.title + ", " + input.motors[wheel].wheel;
      if (!lines.measured_mps.empty()) rows += step_row(what + ", measured", lines.measured);
      rows += step_row(what + ", predicted", lines.predicted);
      figures += fmt::format(
          R"(<figure data-figure="step" data-phase="{}" data-wheel="{}"><figcaption class="phase-{}">{}</figcaption>
<div class="plot" role="img" aria-label="Step of speed {}"></div></figure>)",
          phase, wheel, phase % kAccents, escape(capitalised(what)), escape(what));
    }
    figures += "</div>\n";
  }
  if (figures.empty()) return out;
  out.body =
      R"(<p>The command jumps; the set point is that command behind the robot's own limits. The prediction takes
the measured motor model, the observer and the gains, and the set points that the robot reported.</p>
)" + figures +
      R"(<div class="scroll"><table><thead><tr><th scope="col">Step</th><th scope="col">Rise 10–90 % <span class="unit">ms</span></th>
<th scope="col">Overshoot <span class="unit">%</span></th><th scope="col">Largest error <span class="unit">mm/s</span></th>
<th scope="col">RMS error <span class="unit">mm/s</span></th></tr></thead><tbody>)" +
      rows + "</tbody></table></div>";
  return out;
}

Section about(const TuningInput& input) {
  Section out{"about", "How it was measured", "<dl>"};
  for (const auto& [name, value] : input.description)
    out.body += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape(name), escape(value));
  out.body += "</dl>";
  if (!input.notes.empty()) out.body += "<ul>";
  for (const std::string& note : input.notes) out.body += "<li>" + escape(note) + "</li>\n";
  if (!input.notes.empty()) out.body += "</ul>";
  return out;
}

}  // namespace

std::string render_tuning_html(const TuningInput& input) {
  return render_page(input.title, {steps(input), gains(input), motors(input), about(input)}, data_of(input));
}

}  // namespace astro::report
