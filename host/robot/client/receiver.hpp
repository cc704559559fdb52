#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "common/protocol/framer.hpp"
#include "host/robot/port/transport.hpp"

namespace astro::robot {

/// Reads bodies of good frames from a Transport, one at a time; bytes that were read but not used yet are
/// kept.
class Receiver {
 public:
  /// The next body, valid until the next call. Reads at most once and waits until `deadline` at the longest;
  /// nothing if no body is complete then, and the caller calls again. Throws LinkLost.
  std::optional<std::span<const std::uint8_t>> next(Transport& transport, microseconds deadline) {
    if (begin_ == end_) fill(transport, deadline);
    while (begin_ < end_) {
      if (const auto body = framer_.push(buffer_[begin_++])) return body;
    }
    return std::nullopt;
  }

  /// True if bytes are left that next() takes without reading.
  bool has_more() const { return begin_ < end_; }

  /// Drops everything read so far and what the transport holds, up to a limit, because a robot that streams
  /// never stops sending. Counts start at 0.
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
