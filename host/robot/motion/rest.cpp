#include "host/robot/motion/rest.hpp"

#include <algorithm>

#include "common/safety/wheel_stopped.hpp"
#include "host/robot/parameters/parameters.hpp"

namespace astro::robot {
namespace {

using std::chrono::milliseconds;

constexpr microseconds kStopPoll = milliseconds(50);
constexpr microseconds kUsualRamp = milliseconds(5000);

bool stops_before(Client& client, microseconds deadline, const std::function<void()>& meanwhile) {
  while (protocol::gives_power(client.request(protocol::GetStatus{}).mode)) {
    if (client.now() >= deadline) return false;
    meanwhile();
    client.pump(kStopPoll);
  }
  return true;
}

}  // namespace

microseconds longest_stop(const std::map<std::string, double>& parameters) {
  const auto value = [&](const char* name) {
    const auto found = parameters.find(name);
    return found == parameters.end() ? 0 : found->second;
  };
  const auto seconds = [&](const char* speed, const char* acceleration) {
    return value(acceleration) > 0 ? value(speed) / value(acceleration) : 0;
  };
  const double ramp_s = std::max(seconds("speed_limit", "acceleration_limit"),
                                 seconds("yaw_rate_limit", "yaw_acceleration_limit"));
  return std::max(kUsualRamp, microseconds(static_cast<std::int64_t>(1e6 * (ramp_s + 3))));
}

bool wait_until_wheels_stopped(Client& client) {
  constexpr std::uint16_t kPeriod_ms = 20;
  constexpr microseconds kRollsOn = milliseconds(2000), kNextSample = milliseconds(500);
  bool came = false, stopped = false;
  const auto watching = client.on<protocol::Telemetry>([&](const protocol::Telemetry& sample) {
    came = true;
    stopped = wheel_stopped(sample.wheel_speed.left_umps) && wheel_stopped(sample.wheel_speed.right_umps);
  });
  client.request(protocol::SetTelemetry{kPeriod_ms, protocol::Telemetry::kWheelSpeed});
  if (!client.pump_until([&] { return came; }, kNextSample))
    throw LinkLost(client.name() + " sends no wheel speeds");
  client.pump_until([&] { return stopped; }, kRollsOn);
  client.request(protocol::SetTelemetry{});
  return stopped;
}

bool wait_until_power_off(Client& client, const std::function<void()>& meanwhile) {
  const microseconds start = client.now();
  if (stops_before(client, start + kUsualRamp, meanwhile)) return true;
  if (stops_before(client, start + longest_stop(RemoteParameters::fetch(client).numbers()), meanwhile))
    return true;
  client.request(protocol::Disarm{});
  return false;
}

}  // namespace astro::robot
