#include "host/commands/drive/steering.hpp"

#include <algorithm>

#include "host/console/interrupt.hpp"

namespace astro::commands {
namespace {

constexpr microseconds kPeriod = std::chrono::milliseconds(50);

}  // namespace

void Steering::step(double v_mps, double omega_radps) {
  session_.set_velocity(v_mps, omega_radps);
  const std::uint64_t next_us = client_.device_time_us() + static_cast<std::uint64_t>(kPeriod.count());
  client_.pump_until([&] { return client_.device_time_us() >= next_us || console::interrupted(); }, kPeriod);
}

void Steering::hold(double v_mps, double omega_radps, microseconds duration) {
  const std::uint64_t end_us =
      client_.request(protocol::Ping{}).device_time_us + static_cast<std::uint64_t>(duration.count());
  while (client_.device_time_us() < end_us) step(v_mps, omega_radps);
  session_.stop();
}

}  // namespace astro::commands
