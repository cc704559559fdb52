#include "host/emulator/usb/pipe.hpp"

#include <algorithm>

namespace astro::emulator {

void Pipe::prime(QueueHead head) {
  if (!head.load_transfer()) return;
  primed_ = true;
  empty_packet_due_ = false;
}

void Pipe::take_setup() {
  data1_ = true;
  empty_packet_due_ = false;
}

Packet Pipe::in(QueueHead head) {
  const std::uint32_t left = head.bytes_left(), size = std::min(left, head.packet_size());
  const auto bytes = head.take(size);
  const Packet packet{Handshake::ack, {bytes.begin(), bytes.end()}, data1_};
  data1_ = !data1_;
  if (size < left) return packet;
  const bool full = size == head.packet_size() && size != 0;
  if (full && !empty_packet_due_ && head.ends_with_empty_packet())
    empty_packet_due_ = true;
  else
    retire(head);
  return packet;
}

void Pipe::out(QueueHead head, std::span<const std::uint8_t> bytes) {
  const auto into = head.take(static_cast<std::uint32_t>(bytes.size()));
  std::copy_n(bytes.begin(), into.size(), into.begin());  // nothing if it is no memory
  data1_ = !data1_;
  if (head.bytes_left() == 0 || bytes.size() < head.packet_size()) retire(head);
}

void Pipe::retire(QueueHead head) {
  if (!head.retire()) return;
  primed_ = false;
  empty_packet_due_ = false;
}

}  // namespace astro::emulator
