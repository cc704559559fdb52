#include "host/page/robot/simulated_person.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "host/base/error.hpp"

namespace astro::page {
namespace {

using std::chrono::milliseconds;

constexpr double kPush_Nm = 0.25, kFastest_radps = 8;
constexpr microseconds kLook = milliseconds(1);
constexpr microseconds kLongest = std::chrono::minutes(5);

}  // namespace

SimulatedPerson::SimulatedPerson(robot::Client& client, std::shared_ptr<simulation::VirtualRobot> robot)
    : client_(client),
      robot_(std::move(robot)),
      looked_us_(robot_->board().world_us()),
      on_telemetry_(client.on<protocol::Telemetry>([this](const protocol::Telemetry&) { look(); })) {}

void SimulatedPerson::look() {
  const std::uint64_t now_us = robot_->board().world_us();
  const double passed_s = 1e-6 * static_cast<double>(now_us - std::exchange(looked_us_, now_us));
  for (const Side side : kSides)
    turns_[at(side)] +=
        robot_->board().drivetrain().speed_radps()[at(side)] * passed_s / (2 * std::numbers::pi);
}

void SimulatedPerson::push(double torque_Nm) {
  for (const Side side : kSides) robot_->board().set_load(side, {.torque_Nm = torque_Nm});
}

void SimulatedPerson::wait(microseconds time) {
  client_.pump(time);
  look();
}

void SimulatedPerson::roll(double turns) {
  const auto start = turns_;
  const auto rolled = [&] { return std::min(turns_[0] - start[0], turns_[1] - start[1]); };
  const microseconds end = client_.now() + kLongest;
  while (rolled() < turns && client_.now() < end) {
    push(robot_->board().drivetrain().speed_radps()[0] < kFastest_radps ? kPush_Nm : 0);
    wait(kLook);
  }
  push(0);
  for (double before = -1; before < rolled() && client_.now() < end;) {
    before = rolled();
    for (int ms = 0; ms < 100; ++ms) wait(kLook);
  }
  if (rolled() < turns) throw Error("the robot does not roll");
}

}  // namespace astro::page
