#include "host/robot/sharing/staging_area.hpp"

#include "common/protocol/messages.hpp"
#include "host/robot/sharing/exchange.hpp"
#include "host/robot/sharing/request_rules.hpp"

namespace astro::robot {

bool StagingArea::allows(SessionId id, std::uint8_t message) {
  if (request_rules::opens_staging(message)) {
    opened_ = true;
    owner_ = id;
  }
  return !request_rules::needs_staging(message) || !hides_from(id);
}

void StagingArea::release(SessionId id) {
  if (owner_ == id) owner_.reset();
}

Bytes without_staged(ByteView body) {
  const auto decoded = protocol::decode<protocol::ParameterValue>(body);
  if (!decoded.ok()) return {body.begin(), body.end()};
  protocol::ParameterValue value = *decoded;
  value.staged = value.active;
  value.staged_text = value.active_text;
  return body_of(value, protocol::peek(body)->request_id);
}

}  // namespace astro::robot
