#pragma once

#include <chrono>

#include "host/robot/client/client.hpp"

namespace astro::commands {

/// Requests a restart by M (Reboot, EnterBootloader). The acknowledgement may be lost in the restart, and so
/// may the USB device; therefore a lost link is not an error here, and the caller checks the result.
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
