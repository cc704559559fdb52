#include "host/commands/drive/check_wiring.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>
#include <vector>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/drive/commands.hpp"
#include "host/commands/shared/connection.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/motor/bench/identify.hpp"
#include "host/motor/bench/wiring_check.hpp"
#include "host/motor/model/motor_model.hpp"

namespace astro::commands {
namespace {

using motor::Sighting;
using motor::WiringVerdict;

struct WiringOptions {
  ConnectionOptions connection;
  double max_voltage_V = 4;
  std::array<std::string, 2> saw;  // by motor; empty: ask
  bool no_look = false, roll = false, upload = false, yes = false, json = false;
  motor::RolledLength rolled;  // neither: ask
};

constexpr double kRolledTurns = 10;  // that a person is asked for

void check(const WiringOptions& options) {
  if (options.saw[0].empty() != options.saw[1].empty())
    throw console::WrongUsage(
        "--saw-left and --saw-right go together: what turned for each of the two motors");
  if (options.no_look && !options.saw[0].empty())
    throw console::WrongUsage("--no-look and --saw-left, --saw-right exclude each other");
  if ((options.rolled.distance_m || options.rolled.turns) && !options.roll)
    throw console::WrongUsage("--rolled-distance and --rolled-turns answer --roll: give it too");
}

void agree(const WiringOptions& options) {
  if (options.yes) return;
  if (!console::confirm("Each wheel will turn a little, one after the other. Are both off the ground?"))
    throw Error("nothing was checked: put the robot on a stand first");
}

/// As ask; throws Interrupted if Ctrl-C ended the input.
std::string ask_or_interrupt(const std::string& prompt) {
  try {
    return console::ask_before_acting(prompt);
  } catch (const Error&) {
    console::check_interrupt();
    throw;
  }
}

motor::Look look(Side motor, const WiringOptions& options) {
  if (const std::string& saw = options.saw[at(motor)]; !saw.empty()) return {sighting_from(saw)};
  if (options.no_look || !console::stdin_is_terminal()) return {};
  const std::string answer = ask_or_interrupt(
      "Which wheel turned, and which way? [lf, lb, rf, rb: left/right, forward/backward; none; again] ");
  const std::optional<Sighting> seen = sighting_from(answer);
  if (!seen && answer != "again") console::say(fmt::format("'{}' is none of these: once more", answer));
  return {seen, !seen};
}

std::string counted(const motor::Probe& probe) {
  return fmt::format("up to {:.1f} V: left encoder {:+}, right encoder {:+}", probe.voltage_V,
                     probe.encoders[0].counts, probe.encoders[1].counts);
}

void show(const WiringVerdict& verdict) {
  if (verdict.findings.empty())
    print(verdict.needs_eyes
              ? "each motor turns its own encoder forward; whether the right wheels turned the right "
                "way, only who looks can say"
              : "motors and encoders are wired as the parameters say");
  for (const auto& [fault, remark] : verdict.findings) print(in_words(remark));
}

Json verdict_json(const WiringVerdict& verdict) {
  Json findings = Json::array();
  for (const auto& [fault, remark] : verdict.findings)
    findings.push_back({{"fault", fault}, {"sentence", in_words(remark)}});
  return {{"findings", findings},
          {"parameters", verdict.parameters},
          {"needs_hands", verdict.needs_hands},
          {"needs_eyes", verdict.needs_eyes}};
}

bool wants_upload_of(const std::vector<robot::Change>& changes, const WiringOptions& options) {
  console::say(console::table(experiment::side_by_side(changes), "llrrr"));
  return options.upload || (console::stdin_is_terminal() && console::confirm("Load these into the robot?"));
}

// "2.26", "2.26m" or "10t".
bool understand(const std::string& answer, motor::RolledLength& length) {
  double value = 0;
  const auto [end, problem] = std::from_chars(answer.data(), answer.data() + answer.size(), value);
  const std::string unit(end, static_cast<const char*>(answer.data() + answer.size()));
  if (problem != std::errc() || !(value > 0)) return false;
  if (unit == "t" || unit == " t" || unit == " turns") length.turns = value;
  if (unit.empty() || unit == "m" || unit == " m") length.distance_m = value;
  return length.turns || length.distance_m;
}

motor::RolledLength ask_how_far(const motor::RobotFacts& facts) {
  const double metres = kRolledTurns * std::numbers::pi * facts.wheel_diameter_m;
  console::say(fmt::format(
      "put the robot on the floor and roll it straight on by hand for {:.0f} wheel turns, about {:.2f} m",
      kRolledTurns, metres));
  motor::RolledLength length;
  while (!understand(ask_or_interrupt("How far was it? [metres as 2.26, or wheel turns as 10t] "), length))
    console::say("that is no length: once more");
  return length;
}

motor::WiringHooks hooks_for(const WiringOptions& options) {
  motor::WiringHooks hooks;
  hooks.drive = drive_hooks();
  hooks.driving = [](Side motor) {
    console::say(fmt::format("driving the {} motor forward ...", name(motor)));
  };
  hooks.look = [&options](Side motor) { return look(motor, options); };
  hooks.driven = [](const motor::Probe& probe) { console::say("  " + counted(probe)); };
  hooks.load = [&options](const auto& changes) { return wants_upload_of(changes, options); };
  hooks.uploaded = [](const Remark& remark) { console::say(in_words(remark)); };
  if (options.roll)
    hooks.roll = [&options](const motor::RobotFacts& facts, const std::function<void()>& wait_until_rolled) {
      if (!options.rolled.distance_m && !options.rolled.turns) return ask_how_far(facts);
      console::say("roll the robot now ...");
      wait_until_rolled();
      return options.rolled;
    };
  if (options.json) return hooks;
  hooks.wires_judged = show;
  hooks.roll_judged = [](const motor::RollVerdict& rolled) { print(in_words(rolled.finding)); };
  return hooks;
}

Json result_json(const motor::WiringResult& result) {
  Json json = verdict_json(result.wires);
  if (result.roll)
    json["roll"] = {{"left", result.roll->ratio[0]},
                    {"right", result.roll->ratio[1]},
                    {"agrees", result.roll->agrees},
                    {"sentence", in_words(result.roll->finding)},
                    {"parameters", result.roll->parameters}};
  json["loaded"] = result.in_force && (!result.wires.parameters.empty() || result.roll);
  return json;
}

// What is still to be done, as the error that ends the command.
void conclude(const motor::WiringResult& result) {
  using Next = motor::WiringResult::Next;
  switch (result.next()) {
    case Next::change_wires:
      throw Error("the wiring has to be changed by hand: see above, and run 'astrolabe check-wiring' again");
    case Next::load_parameters:
      throw Error("nothing was changed: --upload loads the corrected parameters");
    case Next::look:
      throw Error("nothing was changed: say with --saw-left and --saw-right, or at a terminal, what turned");
    case Next::nothing:
      break;
  }
}

std::string sighting_words() { return "left-forward, left-backward, right-forward, right-backward or none"; }

console::Check a_sighting() {
  return [](std::string& word) -> std::string {
    if (sighting_from(word)) return {};
    return fmt::format("'{}' is none of {}", word, sighting_words());
  };
}

void add_answers(console::Command command, WiringOptions& options) {
  for (const auto& [option, into, motor] : {std::tuple{"--saw-left", &options.saw[0], "left"},
                                            std::tuple{"--saw-right", &options.saw[1], "right"}})
    command
        .add_option(option, *into,
                    std::string("what turned when the ") + motor + " motor was driven: " + sighting_words())
        .type_name("WORD")
        .check(a_sighting());
  command.add_flag("--no-look", options.no_look, "nobody looks: judge by the counts alone");
  const console::Option metres = command
                                     .add_option("--rolled-distance", options.rolled.distance_m,
                                                 "answer to --roll, in m; waits for the robot to be rolled")
                                     .type_name("M")
                                     .check(console::positive("m"));
  command.add_option("--rolled-turns", options.rolled.turns, "the same in wheel turns")
      .type_name("N")
      .check(console::positive(""))
      .excludes(metres);
}

/// Throws astro::Error if the robot is not in order when it returns: wires to be changed, or parameters that
/// were not loaded.
void check_wiring(WiringOptions& options) {
  check(options);
  const auto client = connect_to_drive(options.connection);
  agree(options);
  const motor::WiringResult result = check_wires(*client, options.max_voltage_V, hooks_for(options));
  if (options.json) print_json(result_json(result));
  conclude(result);
}

constexpr Advice kCheckWiringAdvice[] = {
    {motor::BenchProblem::counts_backward, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {motor::BenchProblem::stands, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
    {motor::MotorProblem::does_not_follow, "; 'astrolabe check-wiring' finds crossed or reversed wires"},
};

}  // namespace

std::optional<Sighting> sighting_from(const std::string& word) {
  static const std::map<std::string, Sighting> kWords{{"lf", {Side::left, true}},
                                                      {"left-forward", {Side::left, true}},
                                                      {"lb", {Side::left, false}},
                                                      {"left-backward", {Side::left, false}},
                                                      {"rf", {Side::right, true}},
                                                      {"right-forward", {Side::right, true}},
                                                      {"rb", {Side::right, false}},
                                                      {"right-backward", {Side::right, false}},
                                                      {"none", {}}};
  const auto found = kWords.find(word);
  return found == kWords.end() ? std::nullopt : std::optional(found->second);
}

void add_check_wiring(console::Command app) {
  advise(kCheckWiringAdvice);
  const auto options = std::make_shared<WiringOptions>();
  const console::Command command = app.add_subcommand(
      "check-wiring", "turn each wheel a little and find wrong wires, polarities and encoder counts");
  add_connection(command, options->connection);
  command.add_option("--max-voltage", options->max_voltage_V, "most that is put on a motor, in V")
      .type_name("V")
      .capture_default_str()
      .check(console::between(0.5, 24, "V"));
  command.add_flag(
      "--roll", options->roll,
      "afterwards: roll the robot ten wheel turns along a tape measure, for counts per revolution");
  add_answers(command, *options);
  command.add_flag("--upload", options->upload, "load corrected parameters without asking");
  add_yes(command, options->yes, "the wheels are off the ground: do not ask");
  add_json_flag(command, options->json);
  console::examples(
      command, {"astrolabe check-wiring", "astrolabe check-wiring --roll",
                "astrolabe check-wiring --yes --saw-left left-forward --saw-right right-backward --upload"});
  command.callback([options] { check_wiring(*options); });
}

}  // namespace astro::commands
