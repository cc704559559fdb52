#include "host/commands/tune/tune_json.hpp"

#include "host/commands/tune/tune_view.hpp"

namespace astro::commands {
namespace {

using motor::kSides;
using motor::Margins;
using motor::Side;
using motor::StepFigures;

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

Json steps_json(const TuneResult& result) {
  Json steps = Json::array();
  for (const TunedStep& step : result.steps) {
    Json one{{"title", step.title}};
    for (const Side side : kSides) {
      if (step.was_measured) one[name(side)]["measured"] = to_json(figures(step.measured[at(side)]));
      one[name(side)]["predicted"] = to_json(figures(step.predicted[at(side)]));
    }
    steps.push_back(one);
  }
  return steps;
}

}  // namespace

Json to_json(const TuneResult& result) {
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

}  // namespace astro::commands
