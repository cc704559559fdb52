#include "host/page/robot/measurements.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "common/fixed/wrapping.hpp"
#include "host/base/error.hpp"
#include "host/motor/bench/bench.hpp"
#include "host/motor/bench/wiring_probe.hpp"
#include "host/motor/model/roll.hpp"
#include "host/page/calls/question.hpp"
#include "host/page/calls/watched_experiment.hpp"
#include "host/page/robot/simulated_person.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::page {
namespace {

using nlohmann::json;

Side side_named(const std::string& word) {
  for (const Side side : kSides)
    if (word == name(side)) return side;
  throw Error(fmt::format("motor is '{}', and must be left or right", word));
}

json by_side(const std::array<double, 2>& values) { return {{"left", values[0]}, {"right", values[1]}}; }

/// What a person saw when a motor was driven: {"wheel": "left", "right" or null, "forward": true}; nothing if nobody looked.
std::optional<motor::Sighting> sighting_in(const json& question, Side motor) {
  const auto saw = question.find("saw");
  if (saw == question.end() || !saw->is_object() || !saw->contains(name(motor))) return std::nullopt;
  const json& seen = (*saw)[name(motor)];
  if (!seen.is_object() || !seen.contains("wheel"))
    throw Error(fmt::format("saw does not say which wheel turned for the {} motor", name(motor)));
  if (seen["wheel"].is_null()) return motor::Sighting{};
  return motor::Sighting{side_named(text_in(seen, "wheel")), flag_in(seen, "forward")};
}

json wheel_json(const motor::IdentifiedMotor& wheel) {
  return {{"kS", wheel.fit.model.kS},
          {"kV", wheel.fit.model.kV},
          {"kA", wheel.fit.model.kA},
          {"r_squared", wheel.fit.r_squared}};
}

json tuning_json(const motor::TuningResult& result) {
  using Change = motor::StepVerdict::Change;
  json changes = json::array();
  for (const robot::Change& each : result.changes)
    changes.push_back({{"name", each.name},
                       {"unit", each.unit},
                       {"before", std::get<double>(each.before)},
                       {"after", std::get<double>(each.after)}});
  const motor::StepVerdict verdict = result.verdict();
  const auto poor = motor::poorly_measured(result.motors);
  const auto ratio = motor::unlikely_kV_ratio(result.gains.mean, result.before);
  return {{"wheels",
           {{"left", wheel_json(result.motors.wheels[0])}, {"right", wheel_json(result.motors.wheels[1])}}},
          {"changes", changes},
          {"loaded", result.uploaded},
          {"follows", verdict.change == Change::better  ? "better"
                      : verdict.change == Change::worse ? "worse"
                                                        : "same"},
          {"rms_before_mps", verdict.before_mps},
          {"rms_now_mps", verdict.now_mps},
          {"was_measured", verdict.was_measured},
          {"unexplained", verdict.unexplained},
          {"poor", poor ? json(name(*poor)) : json(nullptr)},
          {"kV_ratio", ratio ? json(*ratio) : json(nullptr)}};
}

motor::TuningHooks tuning_hooks(const Measurements::Task& task) {
  motor::TuningHooks hooks;
  hooks.drive = task.drive;
  hooks.progress = [&task](double done) { task.tell({{"event", "measuring"}, {"done", done}}); };
  return hooks;
}

}  // namespace

json Measurements::probe_motor(const Task& task, const json& question) {
  const Side motor = side_named(text_in(question, "motor"));
  const double most_V = number_in(question, "most_V", 0.5, 24).value_or(4);
  robot::Client& client = task.session.client();
  motor::Bench bench(client, motor::facts_of(task.session.parameters()));
  std::optional<SimulatedPerson> person;
  if (task.robot.simulation()) person.emplace(client, task.robot.simulation());
  robot::DriveSession session(client, task.drive);
  const motor::Probe probe = motor::probe_motor(bench, session, motor, most_V);
  session.end();
  probes_[at(motor)] = probe;
  return {{"voltage_V", probe.voltage_V},
          {"counts", {{"left", probe.encoders[0].counts}, {"right", probe.encoders[1].counts}}},
          {"turned", person ? by_side(person->turns()) : json(nullptr)}};
}

json Measurements::judge_wiring(live::RobotSession& session, const json& question) const {
  std::array<motor::Probe, 2> probes;
  for (const Side motor : kSides) {
    if (!probes_[at(motor)])
      throw Error(fmt::format("the {} motor was not driven yet: drive both first", name(motor)));
    probes[at(motor)] = *probes_[at(motor)];
    probes[at(motor)].seen = sighting_in(question, motor);
  }
  const motor::WiringVerdict verdict =
      motor::judge_wiring(probes, motor::facts_of(session.parameters()).polarities);
  json findings = json::array();
  for (const auto& [fault, remark] : verdict.findings)
    findings.push_back({{"fault", fault}, {"sentence", remark.sentence}});
  return {{"findings", findings},
          {"parameters", verdict.parameters},
          {"needs_hands", verdict.needs_hands},
          {"needs_eyes", verdict.needs_eyes}};
}

json Measurements::roll(live::RobotSession& session, const protocol::Telemetry& now, const json& question) {
  const std::array counts{now.counts.left, now.counts.right};
  if (flag_in(question, "begin")) {
    roll_from_ = counts;
    return json::object();
  }
  if (!roll_from_) throw Error("nobody said when the robot began to roll: begin again");
  const motor::RobotFacts robot = motor::facts_of(session.parameters());
  motor::Roll roll{{},
                   robot.counts_per_motor_rev,
                   robot.gear_ratio,
                   robot.wheel_diameter_m,
                   number_in(question, "distance_m", 0, 1000),
                   number_in(question, "turns", 0, 10'000)};
  if (roll.distance_m.has_value() == roll.turns.has_value())
    throw Error("say how far the robot rolled: distance_m or turns");
  for (const Side side : kSides)
    roll.counts[at(side)] = wrapping_difference(counts[at(side)], (*roll_from_)[at(side)]);
  const motor::RollVerdict verdict = motor::judge_roll(roll);
  return {{"ratio", by_side(verdict.ratio)},
          {"agrees", verdict.agrees},
          {"sentence", verdict.finding.sentence},
          {"parameters", verdict.parameters}};
}

json Measurements::push(const Task& task, const json& question) {
  if (!task.robot.simulation()) throw Error("a real robot is rolled by hand");
  SimulatedPerson person(task.session.client(), task.robot.simulation());
  person.roll(number_in(question, "turns", 0.5, 100).value_or(10));
  return {{"turns", (person.turns()[0] + person.turns()[1]) / 2}};
}

json Measurements::tune(const Task& task, const json& question) {
  motor::TuningTask wanted;
  wanted.on_stand = flag_in(question, "on_stand");
  wanted.voltage_V = number_in(question, "voltage_V", 1, 50).value_or(wanted.voltage_V);
  wanted.distance_m = number_in(question, "distance_m", 0.2, 50).value_or(wanted.distance_m);
  tuning_.reset();
  tuning_ = motor::tune_motors(task.session.client(), wanted, tuning_hooks(task));
  return tuning_json(*tuning_);
}

json Measurements::load_tuning(const Task& task, const json&) {
  if (!tuning_) throw Error("nothing was measured yet: tune first");
  motor::load_and_measure_again(task.session.client(), *tuning_, tuning_hooks(task));
  return tuning_json(*tuning_);
}

json Measurements::experiment(const Task& task, const json& question) {
  const auto simulated = task.robot.simulation();
  if (!simulated) throw Error("this page sees where a simulated robot is, and no other: it needs a tracker");
  experiment::RunHooks run;
  run.notice = task.drive.notice;
  run.interrupted = task.drive.interrupted;
  run.resting = task.drive.resting;
  return watched_experiment(task.session.client(), simulated, plan_in(question), task.folder, "setup",
                            task.tell, run);
}

}  // namespace astro::page
