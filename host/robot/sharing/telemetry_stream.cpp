#include "host/robot/sharing/telemetry_stream.hpp"

#include <algorithm>
#include <utility>

namespace astro::robot {

using protocol::SetTelemetry;

bool TelemetryRequest::is_due(std::uint64_t device_us, std::uint16_t stream_ms) {
  if (!any()) return false;
  const std::uint64_t period_us = std::uint64_t{1000} * request_.period_ms;
  if (device_us + 2 * period_us < due_us_) due_us_ = 0;  // the robot's clock has restarted
  if (device_us + std::uint64_t{500} * stream_ms < due_us_) return false;
  due_us_ = due_us_ == 0 || due_us_ + period_us <= device_us ? device_us + period_us : due_us_ + period_us;
  return true;
}

SetTelemetry TelemetryRequest::merge(const SetTelemetry& a, const TelemetryRequest& other) {
  const SetTelemetry& b = other.request_;
  if (!other.any()) return a;
  if (a.period_ms == 0) return b;
  return {std::min(a.period_ms, b.period_ms), a.fields | b.fields};
}

void TelemetryStream::request(SessionId id, const SetTelemetry& wanted) {
  requests_[id] = TelemetryRequest(wanted);
  changed_ = true;
}

void TelemetryStream::release(SessionId id) {
  const auto found = requests_.find(id);
  if (found == requests_.end()) return;
  changed_ = changed_ || found->second.any();
  requests_.erase(found);
}

void TelemetryStream::clear() {
  requests_.clear();
  stream_ = {};
  changed_ = false;
}

std::optional<Exchange> TelemetryStream::next_request() {
  if (!std::exchange(changed_, false)) return std::nullopt;
  stream_ = {};
  for (const auto& [id, request] : requests_) stream_ = TelemetryRequest::merge(stream_, request);
  last_id_ = static_cast<std::uint16_t>(last_id_ == 0xFFFF ? 1 : last_id_ + 1);
  return Exchange({SetTelemetry::kId, last_id_}, body_of(stream_, last_id_));
}

std::optional<protocol::Telemetry> TelemetryStream::part_for(SessionId id,
                                                             const protocol::Telemetry& sample) {
  const auto found = requests_.find(id);
  if (found == requests_.end() || !found->second.is_due(sample.device_time_us, stream_.period_ms))
    return std::nullopt;
  return found->second.filter(sample);
}

}  // namespace astro::robot
