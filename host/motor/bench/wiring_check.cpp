#include "host/motor/bench/wiring_check.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <string>

#include "host/base/error.hpp"
#include "host/base/interrupted.hpp"
#include "host/motor/bench/bench.hpp"
#include "host/motor/bench/wiring_probe.hpp"
#include "host/robot/parameters/upload.hpp"

namespace astro::motor {

namespace {

constexpr double kStill_s = 2, kLongestWait_s = 60, kLeastTurn = 0.05;

/// Turns of the wheel that turned more.
double turned(const Moment& now, const Moment& start, const RobotFacts& robot) {
  const auto left = std::llabs(now.counts[0] - start.counts[0]);
  const auto right = std::llabs(now.counts[1] - start.counts[1]);
  return static_cast<double>(std::max(left, right)) / robot.counts_per_turn();
}

/// Records what the wheels count while a person rolls the robot by hand, with its bridges open: waits until the wheels have
/// turned and then stood still for two seconds. `idle` is called at least every 50 ms; an exception of it ends the wait.
void wait_for_roll(Bench& bench, const Moment& start, const std::function<void()>& idle) {
  Moment last = bench.fresh();
  double still_since_s = last.time_s;
  while (true) {
    idle();
    const Moment& now = bench.fresh();
    if (now.counts != last.counts) still_since_s = now.time_s;
    last = now;
    const bool moved = turned(now, start, bench.facts()) > kLeastTurn;
    if (moved && now.time_s - still_since_s >= kStill_s) return;
    if (!moved && now.time_s - start.time_s > kLongestWait_s)
      throw Error("nobody rolled the robot for a minute: nothing was changed");
  }
}

/// The counts since `start` with the robot's parameters.
Roll roll_since(Bench& bench, const Moment& start, const RolledLength& length) {
  const RobotFacts& robot = bench.facts();
  Roll roll{
      {},          robot.counts_per_motor_rev, robot.gear_ratio, robot.wheel_diameter_m, length.distance_m,
      length.turns};
  const Moment& end = bench.fresh();
  for (const Side side : kSides)
    roll.counts[at(side)] = static_cast<double>(end.counts[at(side)] - start.counts[at(side)]);
  return roll;
}

// One session for each motor: nothing is armed while a question is open.
Probe drive_motor(robot::Client& client, const RobotFacts& facts, Side motor, double most_V,
                  const WiringHooks& hooks) {
  Bench bench(client, facts);
  robot::DriveSession session(client, hooks.drive);
  return probe_motor(bench, session, motor, most_V);
}

/// What was seen for one motor; drives it again if it was missed.
Probe drive_and_look(robot::Client& client, const RobotFacts& facts, Side motor, double most_V,
                     const WiringHooks& hooks) {
  while (true) {
    hooks.driving(motor);
    Probe probe = drive_motor(client, facts, motor, most_V, hooks);
    const Look look = hooks.look(motor);
    if (look.again) continue;
    probe.seen = look.seen;
    hooks.driven(probe);
    return probe;
  }
}

/// True if they are in force.
bool offer(robot::Client& client, const std::map<std::string, double>& parameters, const WiringHooks& hooks) {
  const std::map<std::string, robot::Value> values(parameters.begin(), parameters.end());
  const auto changes = robot::changes(robot::RemoteParameters::fetch(client), values);
  if (changes.empty()) return true;
  if (!hooks.load(changes)) return false;
  const robot::UploadReport done = robot::upload(client, values);
  if (done.active != robot::ActiveSet::new_set) throw Error(done.remark());
  hooks.uploaded(done.remark());
  return true;
}

RollVerdict roll(robot::Client& client, const RobotFacts& facts, const WiringHooks& hooks) {
  Bench bench(client, facts);
  const Moment start = bench.fresh();
  const auto wait = [&] {
    wait_for_roll(bench, start, [&] {
      client.pump(std::chrono::milliseconds(50));
      if (hooks.drive.interrupted()) throw Interrupted("interrupted");
    });
  };
  const RolledLength length = hooks.roll(facts, wait);
  return judge_roll(roll_since(bench, start, length));
}

}  // namespace

WiringResult::Next WiringResult::next() const {
  if (wires.needs_hands) return Next::change_wires;
  if (!in_force) return Next::load_parameters;
  return wires.needs_eyes && !wires.findings.empty() ? Next::look : Next::nothing;
}

WiringResult check_wires(robot::Client& client, double most_V, const WiringHooks& hooks) {
  const auto facts = facts_of(robot::RemoteParameters::fetch(client));
  std::array<Probe, 2> probes;
  for (const Side motor : kSides) probes[at(motor)] = drive_and_look(client, facts, motor, most_V, hooks);
  WiringResult result{judge_wiring(probes, facts.polarities), std::nullopt, true};
  hooks.wires_judged(result.wires);
  result.in_force = offer(client, result.wires.parameters, hooks);
  if (!hooks.roll || result.wires.needs_hands) return result;
  result.roll = roll(client, facts, hooks);
  hooks.roll_judged(*result.roll);
  result.in_force = offer(client, result.roll->parameters, hooks) && result.in_force;
  return result;
}

}  // namespace astro::motor
