#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/emulator/usb/queue_head.hpp"

namespace astro::emulator {

/// How the device answers a transaction. `nothing`: it is not attached, or has another address.
enum class Handshake : std::uint8_t { ack, nak, stall, nothing };

struct Packet {
  Handshake handshake = Handshake::nothing;
  std::vector<std::uint8_t> bytes;
  bool data1 = false;
};

/// One direction of an endpoint: whether a transfer is under way (primed), and which of DATA0 and DATA1 the
/// next packet is. What it moves is in the memory behind its queue head.
class Pipe {
 public:
  bool primed() const { return primed_; }
  /// Begins the transfer that the queue head names.
  void prime(QueueHead head);
  void flush() { primed_ = false; }
  void begin_with_data0() { data1_ = false; }
  /// After a SETUP packet DATA1 follows. A primed transfer stays primed.
  void take_setup();

  // A transaction, while a transfer is under way.
  Packet in(QueueHead head);
  /// A packet with the toggle of the one before was repeated by the host: it is acknowledged and dropped.
  bool expects(bool data1) const { return data1 == data1_; }
  /// Precondition: the bytes are not more than the transfer takes.
  void out(QueueHead head, std::span<const std::uint8_t> bytes);

 private:
  void retire(QueueHead head);

  bool primed_ = false, data1_ = false, empty_packet_due_ = false;
};

}  // namespace astro::emulator
