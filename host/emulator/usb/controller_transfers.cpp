#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hal/teensy40/registers/registers.hpp"
#include "host/base/bytes.hpp"
#include "host/emulator/usb/controller.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kHeadBytes = 64, kTransferBytes = 32, kActive = 1U << 7, kHalted = 1U << 6;
constexpr std::uint32_t kInterruptWhenDone = 1U << 15, kInterruptOnSetup = 1U << 15, kPage = 4096;
constexpr std::uint32_t kNoEmptyPacket = 1U << 29;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t index) {
  return load<std::uint32_t>(bytes, 4 * index);
}

void set_word(std::span<std::uint8_t> bytes, std::size_t index, std::uint32_t value) {
  store(bytes, 4 * index, value);
}

/// The data may begin anywhere in the first page; the other four pages must follow it.
bool names_its_pages(std::span<const std::uint8_t> transfer) {
  const std::uint32_t first = word(transfer, 2), end = first + (word(transfer, 1) >> 16 & 0x7FFF);
  for (std::uint32_t page = first / kPage + 1, n = 1; page * kPage < end; ++page, ++n)
    if (n > 4 || word(transfer, 2 + n) / kPage != page) return false;
  return true;
}

}  // namespace

std::span<std::uint8_t> UsbController::head(int endpoint, bool in) {
  return machine_.dma(list_ + kHeadBytes * static_cast<std::uint32_t>(2 * endpoint + (in ? 1 : 0)),
                      kHeadBytes);
}

bool UsbController::stalled(int endpoint, bool in) {
  return (in ? usb::ENDPTCTRL1_TXS : usb::ENDPTCTRL1_RXS).of(control(endpoint)) != 0;
}
bool UsbController::enabled(int endpoint, bool in) {
  return (in ? usb::ENDPTCTRL1_TXE : usb::ENDPTCTRL1_RXE).of(control(endpoint)) != 0;
}
std::uint32_t UsbController::packet_size(int endpoint, bool in) {
  const auto bytes = head(endpoint, in);
  return bytes.empty() ? 0 : word(bytes, 0) >> 16 & 0x7FF;
}

Handshake UsbController::setup(std::uint8_t address, const std::array<std::uint8_t, 8>& bytes) {
  if (!attached() || resetting_ || missed_reset_ || address != address_) return Handshake::nothing;
  const auto queue_head = head(0, false);
  if (queue_head.empty()) return Handshake::nothing;
  std::copy(bytes.begin(), bytes.end(), queue_head.begin() + 40);
  // A stall ends. Primed transfers stay primed, but move no data until the firmware has flushed them.
  control(0) &= ~(usb::ENDPTCTRL0_RXS.mask() | usb::ENDPTCTRL0_TXS.mask());
  for (const bool in : {false, true}) queue(0, in) = {.primed = queue(0, in).primed, .data1 = true};
  command_ &= ~usb::USBCMD_SUTW.mask();
  setup_waiting_ |= 1;
  if ((word(queue_head, 0) & kInterruptOnSetup) != 0) raise(usb::USBSTS_UI(1));
  return Handshake::ack;
}

Packet UsbController::in(std::uint8_t address, int endpoint) {
  Packet packet;
  if (!attached() || resetting_ || missed_reset_ || address != address_ || !enabled(endpoint, true))
    return packet;
  Queue& pipe = queue(endpoint, true);
  packet.handshake = stalled(endpoint, true) ? Handshake::stall : Handshake::nak;
  if (packet.handshake == Handshake::stall || !pipe.primed || setup_waiting_ != 0) return packet;
  const auto queue_head = head(endpoint, true);
  const std::uint32_t token = word(queue_head, 3), left = token >> 16 & 0x7FFF;
  const std::uint32_t size = std::min(left, packet_size(endpoint, true));
  const auto bytes = size == 0 ? std::span<std::uint8_t>{} : machine_.dma(word(queue_head, 4), size);
  packet = {Handshake::ack, {bytes.begin(), bytes.end()}, pipe.data1};
  pipe.data1 = !pipe.data1;
  set_word(queue_head, 3, (token & ~(0x7FFFU << 16)) | (left - size) << 16);
  set_word(queue_head, 4, word(queue_head, 4) + size);
  const bool full = size == packet_size(endpoint, true) && size != 0;
  if (left == size && full && !pipe.empty_packet_due && (word(queue_head, 0) & kNoEmptyPacket) == 0) {
    pipe.empty_packet_due = true;
  } else if (left == size) {
    retire(endpoint, true, 0);
  }
  if (endpoint == 0 && address_due_) {
    address_ = next_address_;
    address_due_ = false;
  }
  return packet;
}

Handshake UsbController::out(std::uint8_t address, int endpoint, std::span<const std::uint8_t> bytes,
                             bool data1) {
  if (!attached() || resetting_ || missed_reset_ || address != address_ || !enabled(endpoint, false))
    return Handshake::nothing;
  if (stalled(endpoint, false)) return Handshake::stall;
  Queue& pipe = queue(endpoint, false);
  if (!pipe.primed || setup_waiting_ != 0) return Handshake::nak;
  if (data1 != pipe.data1) return Handshake::ack;  // a repeated packet: taken and forgotten
  const auto queue_head = head(endpoint, false);
  const std::uint32_t token = word(queue_head, 3), left = token >> 16 & 0x7FFF;
  if (bytes.size() > left) {
    machine_.fail(fmt::format("USB1: endpoint {} receives more than its transfer takes", endpoint));
    return Handshake::stall;
  }
  const auto into = bytes.empty()
                        ? std::span<std::uint8_t>{}
                        : machine_.dma(word(queue_head, 4), static_cast<std::uint32_t>(bytes.size()));
  std::copy(bytes.begin(), bytes.end(), into.begin());
  pipe.data1 = !pipe.data1;
  const auto rest = left - static_cast<std::uint32_t>(bytes.size());
  set_word(queue_head, 3, (token & ~(0x7FFFU << 16)) | rest << 16);
  set_word(queue_head, 4, word(queue_head, 4) + static_cast<std::uint32_t>(bytes.size()));
  if (rest == 0 || bytes.size() < packet_size(endpoint, false)) retire(endpoint, false, rest);
  return Handshake::ack;
}

void UsbController::retire(int endpoint, bool in, std::uint32_t left) {
  const auto queue_head = head(endpoint, in);
  const auto transfer = machine_.dma(word(queue_head, 1), kTransferBytes);
  if (transfer.empty()) return;
  set_word(transfer, 1, (word(transfer, 1) & ~(kActive | 0x7FFFU << 16)) | left << 16);
  set_word(queue_head, 3, word(queue_head, 3) & ~kActive);
  queue(endpoint, in).primed = false;
  queue(endpoint, in).empty_packet_due = false;
  complete_ |= bit_of(endpoint, in);
  raise(usb::USBSTS_UI(1));
}

void UsbController::prime(int endpoint, bool in) {
  if (missed_reset_)
    return machine_.fail(
        "USB1 ENDPTPRIME: a bus reset ended with transfers primed, and the controller was not reset");
  if (queue(endpoint, in).primed)
    return machine_.fail(fmt::format("USB1 ENDPTPRIME: endpoint {} has a transfer under way", endpoint));
  if (endpoint == 0 && setup_waiting_ != 0)
    return machine_.fail("USB1 ENDPTPRIME: endpoint 0 is primed while a SETUP packet waits");
  if (!enabled(endpoint, in))
    return machine_.fail(fmt::format("USB1 ENDPTPRIME: endpoint {} is not enabled", endpoint));
  const auto queue_head = head(endpoint, in);
  if (queue_head.empty()) return;
  const std::uint32_t next = word(queue_head, 2);
  if ((next & 1) != 0) return machine_.fail("USB1 ENDPTPRIME: the queue head names no transfer");
  if (next % kTransferBytes != 0)
    return machine_.fail("USB1 ENDPTPRIME: a transfer that is not aligned to 32 bytes");
  if ((word(queue_head, 3) & kHalted) != 0) return machine_.fail("USB1 ENDPTPRIME: the queue head is halted");
  const auto transfer = machine_.dma(next, kTransferBytes);
  if (transfer.empty()) return;
  if ((word(transfer, 1) & kActive) == 0) return machine_.fail("USB1 ENDPTPRIME: the transfer is not active");
  if ((word(transfer, 0) & 1) == 0)
    return machine_.fail("USB1 ENDPTPRIME: lists of transfers are not modelled");
  if ((word(transfer, 1) & kInterruptWhenDone) == 0)
    return machine_.fail("USB1 ENDPTPRIME: a transfer without IOC is not modelled");
  if (!names_its_pages(transfer))
    return machine_.fail("USB1 ENDPTPRIME: the transfer does not name the pages that follow its first");
  set_word(queue_head, 1, next);
  for (std::size_t i = 0; i < 7; ++i) set_word(queue_head, 2 + i, word(transfer, i));
  queue(endpoint, in).primed = true;
  queue(endpoint, in).empty_packet_due = false;
}

}  // namespace astro::emulator
