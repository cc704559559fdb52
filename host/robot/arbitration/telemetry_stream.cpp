#include "host/robot/arbitration/telemetry_stream.hpp"

#include <utility>

namespace astro::robot {

using protocol::SetTelemetry;

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
