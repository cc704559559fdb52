#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/protocol/messages.hpp"
#include "host/robot/arbitration/exchange.hpp"
#include "host/robot/arbitration/port_user.hpp"
#include "host/robot/arbitration/telemetry_request.hpp"

namespace astro::robot {

/// The one stream of telemetry that the robot sends: what must be requested so that it serves all programs,
/// and which part of a sample each of them gets.
class TelemetryStream {
 public:
  /// The robot is asked again even if nothing changed, because a robot that has restarted has forgotten it.
  void request(SessionId id, const protocol::SetTelemetry& wanted);
  void release(SessionId id);
  /// The robot has stopped the stream and must be asked again.
  void renew() { changed_ = true; }
  /// The robot has restarted: it sends nothing, and the programs have to request telemetry again.
  void clear();

  /// The relay's own request to the robot, once after each change.
  std::optional<Exchange> next_request();

  /// What this program gets of a sample; nothing if it did not request telemetry, or not that often.
  std::optional<protocol::Telemetry> part_for(SessionId id, const protocol::Telemetry& sample);

 private:
  std::map<SessionId, TelemetryRequest> requests_;
  protocol::SetTelemetry stream_;  // what was requested from the robot
  bool changed_ = false;           // the programs' requests, since then
  std::uint16_t last_id_ = 0;      // of the relay's own requests
};

}  // namespace astro::robot
