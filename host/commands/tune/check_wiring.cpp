#include "host/commands/tune/check_wiring.hpp"
#include "host/motor/bench/identify.hpp"
#include "host/motor/model/motor_model.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>

#include "host/base/error.hpp"
#include "host/commands/base/advice.hpp"
#include "host/commands/base/flags.hpp"
#include "host/commands/shared/robot_view.hpp"
#include "host/commands/tune/commands.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/console/options.hpp"
#include "host/console/wrong_usage.hpp"
#include "host/experiment/drive/change_guard.hpp"
#include "host/motor/bench/roll_by_hand.hpp"
#include "host/motor/bench/wiring_probe.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::commands {
namespace {

using motor::Probe;
using motor::Roll;
using motor::Sighting;
using motor::WiringVerdict;

constexpr double kRolledTurns = 10;  // that a person is asked for

bool somebody_is_there() { return isatty(STDIN_FILENO) == 1; }

void check(const WiringOptions& options) {
  if (options.saw[0].empty() != options.saw[1].empty())
    throw console::WrongUsage(
        "--saw-left and --saw-right go together: what turned for each of the two motors");
  if (options.no_look && !options.saw[0].empty())
    throw console::WrongUsage("--no-look and --saw-left, --saw-right exclude each other");
  if ((options.rolled_distance_m || options.rolled_turns) && !options.roll)
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

// One session for each motor: nothing is armed while a question is open.
Probe probe(robot::Client& client, const motor::RobotFacts& facts, Side motor, double most_V) {
  motor::Bench bench(client, facts);
  robot::DriveSession session(client, drive_hooks());
  return probe_motor(bench, session, motor, most_V);
}

/// What was seen for one motor; turns it again if it was missed.
Probe probe_and_look(robot::Client& client, const motor::RobotFacts& facts, Side motor,
                     const WiringOptions& options) {
  while (true) {
    console::say(fmt::format("driving the {} motor forward ...", name(motor)));
    Probe result = probe(client, facts, motor, options.max_voltage_V);
    if (!options.saw[at(motor)].empty()) result.seen = sighting_from(options.saw[at(motor)]);
    if (options.no_look || result.seen || !somebody_is_there()) return result;
    const std::string answer = ask_or_interrupt(
        "Which wheel turned, and which way? [lf, lb, rf, rb: left/right, forward/backward; none; again] ");
    result.seen = sighting_from(answer);
    if (result.seen) return result;
    if (answer != "again") console::say(fmt::format("'{}' is none of these: once more", answer));
  }
}

std::string counted(const Probe& probe) {
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

/// True if they are in force.
bool offer(robot::Client& client, const std::map<std::string, double>& parameters,
           const WiringOptions& options) {
  const experiment::ParameterValues values(parameters.begin(), parameters.end());
  const auto changes = robot::changes(robot::RemoteParameters::fetch(client), values);
  if (changes.empty()) return true;
  console::say(console::table(experiment::side_by_side(changes), "llrrr"));
  if (!options.upload && !(somebody_is_there() && console::confirm("Load these into the robot?")))
    return false;
  const robot::UploadReport done = robot::upload(client, values);
  if (done.active != robot::ActiveSet::new_set) throw Error(done.remark());
  console::say(in_words(done.remark()));
  return true;
}

WiringVerdict look_at_wires(robot::Client& client, const motor::RobotFacts& facts,
                            const WiringOptions& options) {
  std::array<Probe, 2> probes;
  for (const Side motor : kSides) {
    probes[at(motor)] = probe_and_look(client, facts, motor, options);
    console::say("  " + counted(probes[at(motor)]));
  }
  return judge_wiring(probes, facts.polarities);
}

// "2.26", "2.26m" or "10t".
bool understand(const std::string& answer, Roll& roll) {
  double value = 0;
  const auto [end, problem] = std::from_chars(answer.data(), answer.data() + answer.size(), value);
  const std::string unit(end, static_cast<const char*>(answer.data() + answer.size()));
  if (problem != std::errc() || !(value > 0)) return false;
  if (unit == "t" || unit == " t" || unit == " turns") roll.turns = value;
  if (unit.empty() || unit == "m" || unit == " m") roll.distance_m = value;
  return roll.turns || roll.distance_m;
}

Roll ask_how_far(const motor::RobotFacts& facts) {
  const double metres = kRolledTurns * std::numbers::pi * facts.wheel_diameter_m;
  console::say(fmt::format(
      "put the robot on the floor and roll it straight on by hand for {:.0f} wheel turns, about {:.2f} m",
      kRolledTurns, metres));
  Roll roll;
  while (!understand(ask_or_interrupt("How far was it? [metres as 2.26, or wheel turns as 10t] "), roll))
    console::say("that is no length: once more");
  return roll;
}

// What is still to be done, as the error that ends the command.
void conclude(const WiringVerdict& verdict, bool loaded) {
  if (verdict.needs_hands)
    throw Error("the wiring has to be changed by hand: see above, and run 'astrolabe check-wiring' again");
  if (!loaded) throw Error("nothing was changed: --upload loads the corrected parameters");
  if (verdict.needs_eyes && !verdict.findings.empty())
    throw Error("nothing was changed: say with --saw-left and --saw-right, or at a terminal, what turned");
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
                                     .add_option("--rolled-distance", options.rolled_distance_m,
                                                 "answer to --roll, in m; waits for the robot to be rolled")
                                     .type_name("M")
                                     .check(console::positive("m"));
  command.add_option("--rolled-turns", options.rolled_turns, "the same in wheel turns")
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
  const auto facts = motor::facts_of(robot::RemoteParameters::fetch(*client));
  const WiringVerdict verdict = look_at_wires(*client, facts, options);
  Json json = verdict_json(verdict);
  if (!options.json) show(verdict);
  bool loaded = offer(*client, verdict.parameters, options);
  if (options.roll && !verdict.needs_hands) {
    const motor::RollVerdict rolled = roll(*client, facts, options);
    json["roll"] = {{"left", rolled.ratio[0]},
                    {"right", rolled.ratio[1]},
                    {"agrees", rolled.agrees},
                    {"sentence", in_words(rolled.finding)},
                    {"parameters", rolled.parameters}};
    if (!options.json) print(in_words(rolled.finding));
    loaded = offer(*client, rolled.parameters, options) && loaded;
  }
  json["loaded"] = loaded && !(verdict.parameters.empty() && !json.contains("roll"));
  if (options.json) print_json(json);
  conclude(verdict, loaded);
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

motor::RollVerdict roll(robot::Client& client, const motor::RobotFacts& facts, const WiringOptions& options) {
  motor::Bench bench(client, facts);
  const motor::Moment start = bench.fresh();
  Roll answer;
  if (options.rolled_distance_m || options.rolled_turns) {
    console::say("roll the robot now ...");
    wait_for_roll(bench, start, [&] {
      client.pump(std::chrono::milliseconds(50));
      console::check_interrupt();
    });
    answer.distance_m = options.rolled_distance_m;
    answer.turns = options.rolled_turns;
  } else {
    answer = ask_how_far(facts);
  }
  return judge_roll(roll_since(bench, start, answer.distance_m, answer.turns));
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
