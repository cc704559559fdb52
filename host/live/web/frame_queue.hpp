#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "host/base/bytes.hpp"

namespace astro::web {

/// One message that several clients share.
struct Sample {
  std::int64_t time_ns = 0;
  Bytes payload;
};
using SharedSample = std::shared_ptr<const Sample>;

/// One WebSocket message: `head`, then the payload of `sample` if there is one.
struct Frame {
  bool is_text = false;
  std::string head;
  SharedSample sample;
  std::uint32_t subscription = 0;  // of a sample

  std::size_t size() const { return head.size() + (sample ? sample->payload.size() : 0); }
};

/// What waits to be sent to one client. Control messages (answers, lists, latched topics) go first and are never dropped; of
/// data the oldest is dropped when more waits than fits.
///
/// Bounds  data: 4 MiB or 16384 messages, about a second of a robot's fastest telemetry: a browser may stall for so long, and
///         older data is of no use to somebody who watches. Control messages: 4 MiB or 4096; beyond that the client must be
///         disconnected.
class FrameQueue {
 public:
  static constexpr std::size_t kMostData = 16384, kMostDataBytes = 4 << 20;
  static constexpr std::size_t kMostControl = 4096, kMostControlBytes = 4 << 20;

  void push_control(Frame frame);
  void push_data(Frame frame);

  /// What is to be sent next; nothing if nothing waits.
  std::optional<Frame> pop();
  /// Removes what waits for a subscription: a client may give its number to another channel.
  void forget(std::uint32_t subscription);

  bool overflowed() const { return overflowed_; }
  bool empty() const { return control_.empty() && data_.empty(); }
  /// The number of data messages that were dropped since the start.
  std::uint64_t dropped() const { return dropped_; }

 private:
  void drop_oldest();

  std::deque<Frame> control_, data_;
  std::size_t control_bytes_ = 0, data_bytes_ = 0;
  std::uint64_t dropped_ = 0;
  bool overflowed_ = false;
};

}  // namespace astro::web
