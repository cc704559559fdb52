#include "host/commands/tune/wiring_roll.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numbers>

#include "host/base/error.hpp"
#include "host/console/console.hpp"
#include "host/console/interrupt.hpp"
#include "host/motor/bench/bench.hpp"

namespace astro::commands {
namespace {

using motor::kSides;
using motor::Roll;
using motor::Moment;

constexpr double kTurns = 10;

double turned(const Moment& now, const Moment& start, const motor::RobotFacts& facts) {
  const auto left = std::llabs(now.counts[0] - start.counts[0]),
             right = std::llabs(now.counts[1] - start.counts[1]);
  return static_cast<double>(std::max(left, right)) / facts.counts_per_turn();
}

/// For scripts: until the wheels have turned and then stood for two seconds.
void wait_for_roll(robot::Client& client, motor::Bench& bench, const Moment& start) {
  constexpr double kStill_s = 2, kPatience_s = 60, kLeast_turns = 0.05;
  Moment last = bench.fresh();
  double still_since_s = last.time_s;
  while (true) {
    client.pump(std::chrono::milliseconds(50));
    console::check_interrupt();
    const Moment& now = bench.fresh();
    if (now.counts != last.counts) still_since_s = now.time_s;
    last = now;
    const bool moved = turned(now, start, bench.facts()) > kLeast_turns;
    if (moved && now.time_s - still_since_s >= kStill_s) return;
    if (!moved && now.time_s - start.time_s > kPatience_s)
      throw Error("nobody rolled the robot for a minute: nothing was changed");
  }
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

void ask_how_far(Roll& roll) {
  const double metres = kTurns * std::numbers::pi * roll.wheel_diameter_m;
  console::say(fmt::format(
      "put the robot on the floor and roll it straight on by hand for {:.0f} wheel turns, about {:.2f} m",
      kTurns, metres));
  while (!understand(ask_or_interrupt("How far was it? [metres as 2.26, or wheel turns as 10t] "), roll))
    console::say("that is no length: once more");
}

}  // namespace

std::string ask_or_interrupt(const std::string& prompt) {
  try {
    return console::ask(prompt);
  } catch (const Error&) {
    console::check_interrupt();
    throw;
  }
}

motor::RollVerdict roll(robot::Client& client, const motor::RobotFacts& facts,
                                 const WiringOptions& options) {
  Roll roll{{},
            facts.counts_per_motor_rev,
            facts.gear_ratio,
            facts.wheel_diameter_m,
            options.rolled_distance_m,
            options.rolled_turns};
  motor::Bench bench(client, facts);
  const Moment start = bench.fresh();
  if (roll.distance_m || roll.turns) {
    console::say("roll the robot now ...");
    wait_for_roll(client, bench, start);
  } else {
    ask_how_far(roll);
  }
  const Moment& end = bench.fresh();
  for (const auto side : kSides)
    roll.counts[at(side)] = static_cast<double>(end.counts[at(side)] - start.counts[at(side)]);
  return judge_roll(roll);
}

}  // namespace astro::commands
