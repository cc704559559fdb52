#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/protocol/framer.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// Bodies of good frames from a Transport, one at a time; what was read and not taken yet is kept.
class Receiver {
 public:
  /// The next body, valid until the next call; nothing if none is complete by `deadline` or after the first
  /// bytes that came: the caller asks again. Throws LinkLost.
  std::optional<std::span<const std::uint8_t>> next(Transport& transport, microseconds deadline) {
    if (begin_ == end_) fill(transport, deadline);
    while (begin_ < end_) {
      if (const auto body = framer_.push(buffer_[begin_++])) return body;
    }
    return std::nullopt;
  }

  /// Bytes wait that next() takes without reading.
  bool has_more() const { return begin_ < end_; }

  /// Forgets everything read so far and whatever the transport holds, up to a bound: a robot that streams
  /// never falls silent. Counts start at 0.
  void drain(Transport& transport) {
    constexpr int kReads = 16;
    *this = Receiver();
    for (int i = 0; i < kReads && transport.read(buffer_, microseconds::zero()) > 0; ++i) {
    }
  }

  const protocol::FrameCounts& frames() const { return framer_.counts(); }
  std::uint64_t bytes() const { return bytes_; }

 private:
  std::array<std::uint8_t, 4096> buffer_{};
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::uint64_t bytes_ = 0;
  protocol::Framer framer_;

  void fill(Transport& transport, microseconds deadline) {
    const microseconds left = deadline - transport.now();
    begin_ = end_ = 0;
    end_ = transport.read(buffer_, left > microseconds::zero() ? left : microseconds::zero());
    bytes_ += end_;
  }
};

}  // namespace astro::robot
