#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "common/protocol/codec.hpp"
#include "common/protocol/fault_log.hpp"
#include "common/protocol/framer.hpp"
#include "common/protocol/motion.hpp"
#include "common/protocol/parameters.hpp"
#include "common/protocol/session.hpp"
#include "common/protocol/status.hpp"
#include "common/protocol/telemetry.hpp"

/// THE schema: every message of the protocol. Wire order and layout follow from the kFields tuples; README.md
/// in this folder is generated from them.
///
/// Ids     0x01-0x3F   requests
///         0x80 | id   the reply of the request with that id
///         0x7E, 0x7F  the general replies
///         0xC0-0xFF   events
///         Append only: an id that was once used keeps its meaning or is left unused.
namespace astro::protocol {

/// A list of message types. `visit` calls `f.template operator()<M>()` for each, in order.
template <Message... M>
struct MessageList {
  static constexpr std::size_t kSize = sizeof...(M);

  template <class F>
  static constexpr void visit(F&& f) {
    (f.template operator()<M>(), ...);
  }
};

using Requests =
    MessageList<Hello, Ping, GetStatus, Arm, Disarm, Stop, EmergencyStop, Velocity, AddSegment, SetPose,
                GetParameterInfo, GetParameter, StageParameter, CommitParameters, RevertParameters,
                DefaultParameters, SetTelemetry, GetFaults, ClearFaults, Reboot, EnterBootloader,
                WheelVoltage, Pause, Resume, GetFaultLog, ApplyParameters, Rest>;
using Replies = MessageList<Ack, ErrorReply, HelloReply, Pong, Status, ParameterInfo, ParameterValue,
                            FaultReport, FaultLogEntry>;
using Events =
    MessageList<Telemetry, SegmentDone, FaultRaised, Booted, SegmentStarted, EventsMissed, SlipFound>;

/// The size of the largest frame of these messages, with its 0x00.
template <Message... M>
consteval std::size_t largest_frame(MessageList<M...>) {
  return largest_frame_of(std::max({kBodySize<M>...}));
}
inline constexpr std::size_t kMaxReplyFrame = largest_frame(Replies{});
/// The same for the events other than Telemetry.
inline constexpr std::size_t kMaxEventFrame =
    largest_frame(MessageList<SegmentDone, FaultRaised, Booted, SegmentStarted, EventsMissed, SlipFound>{});

}  // namespace astro::protocol
