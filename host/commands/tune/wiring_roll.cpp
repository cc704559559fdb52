#include "host/commands/tune/wiring_roll.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <numbers>

#include "host/base/error.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/motor/bench/roll_by_hand.hpp"

namespace astro::commands {
namespace {

using motor::Roll;

constexpr double kTurns = 10;

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
  const double metres = kTurns * std::numbers::pi * facts.wheel_diameter_m;
  console::say(fmt::format(
      "put the robot on the floor and roll it straight on by hand for {:.0f} wheel turns, about {:.2f} m",
      kTurns, metres));
  Roll roll;
  while (!understand(ask_or_interrupt("How far was it? [metres as 2.26, or wheel turns as 10t] "), roll))
    console::say("that is no length: once more");
  return roll;
}

}  // namespace

std::string ask_or_interrupt(const std::string& prompt) {
  try {
    return console::ask_before_acting(prompt);
  } catch (const Error&) {
    console::check_interrupt();
    throw;
  }
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

}  // namespace astro::commands
