#pragma once

#include <cstdint>

#include "common/protocol/messages.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// How long to wait for a reply before the request is sent again, and how many times it is sent in all. The
/// default is about one second in steps so short that a moving robot may miss two frames in a row within its
/// time-out of 200 ms. A reply that takes longer than a step costs one repetition and nothing else.
struct RetryPolicy {
  microseconds timeout = std::chrono::milliseconds(60);
  int tries = 16;
};

/// A commit may have to erase flash, which can take seconds during which the robot does not answer.
template <protocol::Request M>
constexpr RetryPolicy retry_policy_for() {
  if constexpr (M::kId == protocol::CommitParameters::kId) return {std::chrono::milliseconds(250), 16};
  return {};
}

/// Counts of the link since connect(). The receiver counts frames that were not good.
struct LinkCounts {
  std::uint64_t requests = 0, repeats = 0, pings = 0, lost_pings = 0;
  std::uint64_t missed_events =
      0;  // the robot reports that it dropped them because nobody read its port in time
  std::uint64_t stale_replies = 0;  // to a request that was answered already, or not ours
};

}  // namespace astro::robot
