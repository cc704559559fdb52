#include "host/commands/drive/tune_view.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <numbers>
#include <span>

#include "host/base/text/degrees.hpp"
#include "host/console/console.hpp"
#include "host/robot/client/handshake.hpp"

namespace astro::commands {
namespace {

using motor::Margins;
using motor::StepFigures;

double hertz(double radps) { return radps / (2 * std::numbers::pi); }

std::string with_error(double value, double error) {
  const int decimals = std::clamp(1 - static_cast<int>(std::floor(std::log10(std::max(error, 1e-6)))), 0, 4);
  return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
}

std::string volts(const std::optional<double>& value) { return value ? fmt::format("{:.2f}", *value) : "-"; }

std::string motor_table(const motor::TuningResult& result) {
  std::vector<std::vector<std::string>> rows{
      {"wheel", "kS [V]", "kV [Vs/m]", "kA [Vs^2/m]", "time constant", "breaks away", "residual"}};
  for (const Side side : kSides) {
    const auto& [fit, forward_V, backward_V] = result.motors.wheels[at(side)];
    rows.push_back({name(side), with_error(fit.model.kS, fit.standard_error.kS),
                    with_error(fit.model.kV, fit.standard_error.kV),
                    with_error(fit.model.kA, fit.standard_error.kA),
                    fmt::format("{:.0f} ms", 1e3 * fit.model.time_constant_s()),
                    fmt::format("+{} / -{} V", volts(forward_V), volts(backward_V)),
                    fmt::format("{:.0f} mV", 1e3 * fit.residual_V)});
  }
  return console::table(rows);
}

std::string margins_in_words(const Margins& margins) {
  return fmt::format("bandwidth {:.1f} Hz, phase margin {:.0f} deg, gain margin {:.1f}",
                     hertz(margins.bandwidth_radps), degrees(margins.phase_margin_rad), margins.gain_margin);
}

report::StepLines lines(const motor::TunedStep& step, Side side) {
  const motor::StepCourse& course = step.measured[at(side)];
  report::StepLines out;
  out.time_s = course.time_s;
  out.set_point_mps = course.set_point_mps;
  if (step.was_measured) out.measured_mps = course.observed_mps;
  out.predicted_mps = step.predicted[at(side)].observed_mps;
  if (step.was_measured) out.measured = figures(course);
  out.predicted = figures(step.predicted[at(side)]);
  return out;
}

double error_of(const motor::TuningResult& result, const std::string& parameter) {
  for (const Side side : kSides) {
    const auto& error = result.motors.wheels[at(side)].fit.standard_error;
    if (parameter == std::string("kS_") + name(side)) return error.kS;
    if (parameter == std::string("kV_") + name(side)) return error.kV;
    if (parameter == std::string("kA_") + name(side)) return error.kA;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

const char* stand_note() {
  return "measured off the ground: kA and the gains lack the robot's mass, so only kS and kV are offered; "
         "'astrolabe tune --on-ground' finds the others";
}

struct TitledStep {
  const char* title;
  const motor::TunedStep& step;
};

std::array<TitledStep, 3> steps_of(const motor::TuningResult& result) {
  return {{{"before", result.step_before},
           {result.uploaded ? "after" : "with the new values", result.step_after},
           {"a jump, new gains alone", result.jump}}};
}

std::string steps_in_words(std::span<const TitledStep> steps) {
  std::vector<std::vector<std::string>> rows{
      {"step", "wheel", "", "rise 10-90 %", "overshoot", "largest error", "rms error"}};
  const auto add = [&](const char* title, Side side, const char* what, const StepFigures& figures) {
    rows.push_back({title, name(side), what, fmt::format("{:.0f} ms", 1e3 * figures.rise_s),
                    fmt::format("{:.1f} %", 100 * figures.overshoot),
                    fmt::format("{:.1f} mm/s", 1e3 * figures.worst_error_mps),
                    fmt::format("{:.1f} mm/s", 1e3 * figures.rms_error_mps)});
  };
  for (const auto& [title, step] : steps) {
    for (const Side side : kSides) {
      if (step.was_measured) add(title, side, "measured", figures(step.measured[at(side)]));
      add(title, side, "predicted", figures(step.predicted[at(side)]));
    }
  }
  return console::table(rows, "lllrrrr");
}

Json to_json(const StepFigures& figures) {
  return {{"rise_s", figures.rise_s},
          {"overshoot", figures.overshoot},
          {"worst_error_mps", figures.worst_error_mps},
          {"rms_error_mps", figures.rms_error_mps}};
}

Json to_json(const Margins& margins) {
  return {{"bandwidth_radps", margins.bandwidth_radps},
          {"crossover_radps", margins.crossover_radps},
          {"phase_margin_rad", margins.phase_margin_rad},
          {"gain_margin", margins.gain_margin},
          {"sensitivity", margins.sensitivity}};
}

Json to_json(const motor::IdentifiedMotor& wheel) {
  const auto& [model, error, residual_V, r_squared, windows] = wheel.fit;
  const auto pair = [](double value, double se) { return Json{{"value", value}, {"standard_error", se}}; };
  const auto number = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  return {{"kS", pair(model.kS, error.kS)},
          {"kV", pair(model.kV, error.kV)},
          {"kA", pair(model.kA, error.kA)},
          {"time_constant_s", model.time_constant_s()},
          {"breakaway_forward_V", number(wheel.breakaway_forward_V)},
          {"breakaway_backward_V", number(wheel.breakaway_backward_V)},
          {"residual_V", residual_V},
          {"r_squared", r_squared},
          {"windows", windows.size()}};
}

Json steps_json(const motor::TuningResult& result) {
  Json steps = Json::array();
  for (const auto& [title, step] : steps_of(result)) {
    Json one{{"title", title}};
    for (const Side side : kSides) {
      if (step.was_measured) one[name(side)]["measured"] = to_json(figures(step.measured[at(side)]));
      one[name(side)]["predicted"] = to_json(figures(step.predicted[at(side)]));
    }
    steps.push_back(one);
  }
  return steps;
}

}  // namespace

std::vector<std::string> notes(const motor::TuningResult& result) {
  std::vector<std::string> list;
  if (result.on_stand) list.emplace_back(stand_note());
  if (const auto ratio = motor::unlikely_kV_ratio(result.gains.mean, result.before))
    list.push_back(
        fmt::format("kV is {:.2g} times the value that was loaded: other motors or wheels, or a wrong "
                    "counts_per_motor_rev; 'astrolabe check-wiring --roll' tells",
                    *ratio));
  return list;
}

std::string step_after_in_words(const motor::TuningResult& result) {
  const auto steps = steps_of(result);
  return result.uploaded ? steps_in_words(std::span(steps).subspan(1, 1)) : "";
}

std::string verdict(const motor::TuningResult& result) {
  using Change = motor::StepVerdict::Change;
  const motor::StepVerdict judged = result.verdict();
  std::string text = fmt::format(
      "Verdict: with the new values the wheels {} their set point {} before: rms error {:.1f} mm/s, before "
      "{:.1f}",
      judged.was_measured ? "follow" : "should follow",
      judged.change == Change::better  ? "better than"
      : judged.change == Change::worse ? "worse than"
                                       : "about as well as",
      1e3 * judged.now_mps, 1e3 * judged.before_mps);
  text += judged.was_measured ? fmt::format(", predicted {:.1f};", 1e3 * judged.predicted_mps)
                              : " (predicted, not measured);";
  text += fmt::format(" phase margin {:.0f} deg, before {:.0f}.",
                      degrees(result.gains.design.margins.phase_margin_rad),
                      degrees(result.gains.margins_before.phase_margin_rad));
  if (!judged.was_measured) return text;
  if (judged.change == Change::worse)
    text += " The old values are in the table of changes above; 'astrolabe params set' puts them back.";
  else if (judged.unexplained)
    text += " The model explains less than half of it: look for slip, play or a weak supply.";
  return text;
}

std::string in_words(const motor::TuningResult& result) {
  std::string text = motor_table(result);
  text += fmt::format(
      "\nloaded    kp {:.4g}, ki {:.4g}: {}\ndesigned  kp {:.4g}, ki {:.4g}: {}\n          at most "
      "{:.1f} Hz with this observer_bandwidth; encoder noise {:.0f} mV on the motors\n\n",
      result.before.kp, result.before.ki, margins_in_words(result.gains.margins_before),
      result.gains.design.kp, result.gains.design.ki, margins_in_words(result.gains.design.margins),
      hertz(result.gains.design.largest_bandwidth_radps), 1e3 * result.gains.design.noise_V);
  text += steps_in_words(steps_of(result));
  for (const std::string& note : notes(result)) text += fmt::format("\n{}\n", note);
  return text;
}

Json to_json(const motor::TuningResult& result) {
  Json changes = Json::array();
  for (const robot::Change& change : result.changes)
    changes.push_back({{"name", change.name},
                       {"unit", change.unit},
                       {"before", std::get<double>(change.before)},
                       {"after", std::get<double>(change.after)}});
  return {
      {"on_stand", result.on_stand},
      {"wheels", {{"left", to_json(result.motors.wheels[0])}, {"right", to_json(result.motors.wheels[1])}}},
      {"carried",
       {{"kp", result.before.kp},
        {"ki", result.before.ki},
        {"margins", to_json(result.gains.margins_before)}}},
      {"designed",
       {{"kp", result.gains.design.kp},
        {"ki", result.gains.design.ki},
        {"margins", to_json(result.gains.design.margins)},
        {"noise_V", result.gains.design.noise_V},
        {"largest_bandwidth_radps", result.gains.design.largest_bandwidth_radps}}},
      {"changes", changes},
      {"steps", steps_json(result)},
      {"notes", notes(result)},
      {"verdict", verdict(result)},
      {"uploaded", result.uploaded}};
}

report::TuningInput report_input(const motor::TuningResult& result, const robot::Client& client) {
  const auto nan = std::numeric_limits<double>::quiet_NaN();
  report::TuningInput input;
  input.title = fmt::format("Tuning of {}", client.robot().robot_name.view());
  for (const Side side : kSides) {
    const auto& [fit, forward_V, backward_V] = result.motors.wheels[at(side)];
    input.motors[at(side)] = {name(side), fit, forward_V.value_or(nan), backward_V.value_or(nan)};
  }
  for (const robot::Change& change : result.changes)
    input.parameters.push_back({change.name, change.unit, std::get<double>(change.before),
                                std::get<double>(change.after), error_of(result, change.name)});
  input.loop = {
      {"Designed", fmt::format("kp {:.4g} V s/m, ki {:.4g} V/m: {}", result.gains.design.kp,
                               result.gains.design.ki, margins_in_words(result.gains.design.margins))},
      {"Loaded before", margins_in_words(result.gains.margins_before)},
      {"Observer", fmt::format("{:.0f} rad/s; allows at most {:.1f} Hz", result.before.observer_radps,
                               hertz(result.gains.design.largest_bandwidth_radps))}};
  for (const auto& [title, step] : steps_of(result))
    input.steps.push_back({title, {lines(step, Side::left), lines(step, Side::right)}});
  input.description = {
      {"Robot", std::string(client.robot().robot_name.view())},
      {"Robot id", hex_id(client.robot())},
      {"Firmware", robot::firmware_version(client.robot())},
      {"Measured", fmt::format("{:%Y-%m-%d %H:%M} UTC, {}", fmt::gmtime(std::time(nullptr)),
                               result.on_stand ? "wheels off the ground" : "on the ground")},
      {"Samples", fmt::format("every {:.0f} ms for {:.0f} s", 1e3 * result.period_s, result.motors.seconds)},
      {"New values", result.uploaded ? "loaded into the robot" : "not loaded"}};
  input.notes = notes(result);
  return input;
}

}  // namespace astro::commands
