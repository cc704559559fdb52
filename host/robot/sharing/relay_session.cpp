#include "host/robot/sharing/relay_session.hpp"

#include "common/protocol/frame.hpp"

namespace astro::robot {

namespace {

constexpr std::size_t kTelemetryLimit_bytes = 1U << 16;
constexpr std::size_t kQueueLimit_bytes = 1U << 18;

}  // namespace

bool RelaySession::takes_telemetry() const { return out.bytes() <= kTelemetryLimit_bytes; }

bool RelaySession::push(ByteView frame) {
  if (out.bytes() + frame.size() > kQueueLimit_bytes) return false;
  out.push(frame);
  return true;
}

void RelaySession::close(FarewellReason reason) {
  closing = Farewell{reason};
  if (reason == FarewellReason::reads_too_slowly) out.drop_waiting();
  if (greets) out.push(protocol::Frame(*closing, 0).bytes());
}

}  // namespace astro::robot
