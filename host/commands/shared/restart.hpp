#pragma once

#include <chrono>

#include "host/robot/client/client.hpp"

namespace astro::commands {

/// Asks for a restart by M (Reboot, EnterBootloader). The restart may take its own acknowledgement with it,
/// and the USB device; what comes after tells.
template <protocol::Request M>
void request_restart(robot::Client& client) {
  constexpr auto kUntilItGoes = std::chrono::milliseconds(500);
  bool booted = false;
  const auto subscription = client.on<protocol::Booted>([&](const protocol::Booted&) { booted = true; });
  try {
    client.request(M{});
    client.pump_until([&] { return booted; }, kUntilItGoes);
  } catch (const robot::LinkLost&) {
  }
}

}  // namespace astro::commands
