#pragma once

#include <cstdint>

#include "common/protocol/messages.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// How long to wait for a reply before the request is sent again, and how often it is sent in all. By default
/// one second, in steps that let a moving robot miss two frames in a row within its time-out of 200 ms; a
/// reply that takes longer than a step costs a repetition and nothing else.
struct Patience {
  microseconds timeout = std::chrono::milliseconds(60);
  int tries = 16;
};

/// Flash may have to be erased for a commit, which can take seconds and deafens the robot meanwhile.
template <protocol::Request M>
constexpr Patience patience_for() {
  if constexpr (M::kId == protocol::CommitParameters::kId) return {std::chrono::milliseconds(250), 16};
  return {};
}

/// What a link went through since connect(). Frames that were not good are counted by the receiver.
struct LinkCounts {
  std::uint64_t requests = 0, repeats = 0, pings = 0, lost_pings = 0;
  std::uint64_t missed_events = 0;  // the robot says that it dropped them: nobody read its port in time
  std::uint64_t stale_replies = 0;  // to a request that was answered already, or not ours
};

}  // namespace astro::robot
