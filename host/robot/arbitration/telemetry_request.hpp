#pragma once

#include <algorithm>
#include <cstdint>

#include "common/protocol/telemetry.hpp"

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
  bool is_due(std::uint64_t device_us, std::uint16_t stream_ms) {
    if (!any()) return false;
    const std::uint64_t period_us = std::uint64_t{1000} * request_.period_ms;
    if (device_us + 2 * period_us < due_us_) due_us_ = 0;  // the robot's clock has restarted
    if (device_us + std::uint64_t{500} * stream_ms < due_us_) return false;
    due_us_ = due_us_ == 0 || due_us_ + period_us <= device_us ? device_us + period_us : due_us_ + period_us;
    return true;
  }

  /// The requested groups that are in the sample; all others are blank, as if never sent.
  protocol::Telemetry filter(protocol::Telemetry sample) const {
    sample.fields &= request_.fields;
    return sample;
  }

  /// One stream that serves both: all groups of either, at the shorter period.
  static protocol::SetTelemetry merge(const protocol::SetTelemetry& a, const TelemetryRequest& other) {
    const protocol::SetTelemetry& b = other.request_;
    if (!other.any()) return a;
    if (a.period_ms == 0) return b;
    return {std::min(a.period_ms, b.period_ms), a.fields | b.fields};
  }

 private:
  protocol::SetTelemetry request_;
  std::uint64_t due_us_ = 0;  // on the robot's clock; 0: at once
};

}  // namespace astro::robot
