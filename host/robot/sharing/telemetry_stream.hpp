#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "common/protocol/messages.hpp"
#include "common/protocol/telemetry.hpp"
#include "host/robot/sharing/exchange.hpp"
#include "host/robot/sharing/port_user.hpp"

namespace astro::robot {

/// The telemetry that one of several programs at a port requested, selected from a stream that serves all of
/// them.
class TelemetryRequest {
 public:
  TelemetryRequest() = default;
  explicit TelemetryRequest(const protocol::SetTelemetry& request) : request_(request) {}

  bool any() const { return request_.period_ms != 0; }

  /// True if this sample of a stream with period `stream_ms` must be passed on. Keeps the mean rate: each due
  /// sample is at most half a period of the stream early or late.
  bool is_due(std::uint64_t device_us, std::uint16_t stream_ms);

  /// The requested groups that are in the sample; all others are blank, as if never sent.
  protocol::Telemetry filter(protocol::Telemetry sample) const {
    sample.fields &= request_.fields;
    return sample;
  }

  /// One stream that serves both: all groups of either, at the shorter period.
  static protocol::SetTelemetry merge(const protocol::SetTelemetry& a, const TelemetryRequest& other);

 private:
  protocol::SetTelemetry request_;
  std::uint64_t due_us_ = 0;  // on the robot's clock; 0: at once
};

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
