#include "host/emulator/robot/endpoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "hal/teensy40/registers/registers.hpp"
#include "host/base/bytes.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr std::uint32_t kTransferBytes = 32, kActive = 1U << 7, kHalted = 1U << 6, kPage = 4096;
constexpr std::uint32_t kInterruptWhenDone = 1U << 15, kInterruptOnSetup = 1U << 15;
constexpr std::uint32_t kNoEmptyPacket = 1U << 29, kLengthMask = 0x7FFF, kLengthShift = 16;
constexpr std::size_t kSetupOffset = 40;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t index) {
  return load<std::uint32_t>(bytes, 4 * index);
}

void set_word(std::span<std::uint8_t> bytes, std::size_t index, std::uint32_t value) {
  store(bytes, 4 * index, value);
}

std::uint32_t length_of(std::uint32_t token) { return token >> kLengthShift & kLengthMask; }
std::uint32_t with_length(std::uint32_t token, std::uint32_t length) {
  return (token & ~(kLengthMask << kLengthShift)) | length << kLengthShift;
}

/// Whether the descriptor names its pages: the data may begin anywhere in the first one; the other four must
/// follow it.
bool names_its_pages(std::span<const std::uint8_t> transfer) {
  const std::uint32_t first = word(transfer, 2), end = first + length_of(word(transfer, 1));
  for (std::uint32_t page = first / kPage + 1, n = 1; page * kPage < end; ++page, ++n)
    if (n > 4 || word(transfer, 2 + n) / kPage != page) return false;
  return true;
}

/// What is wrong with a descriptor.
std::optional<Remark> fault_of(std::span<const std::uint8_t> transfer) {
  if ((word(transfer, 1) & kActive) == 0)
    return Remark{"USB1 ENDPTPRIME: the transfer is not active", EndpointProblem::transfer_inactive};
  if ((word(transfer, 0) & 1) == 0)
    return Remark{"USB1 ENDPTPRIME: lists of transfers are not modelled", EndpointProblem::list_not_modelled};
  if ((word(transfer, 1) & kInterruptWhenDone) == 0)
    return Remark{"USB1 ENDPTPRIME: a transfer without IOC is not modelled",
                  EndpointProblem::no_interrupt_when_done};
  if (!names_its_pages(transfer))
    return Remark{"USB1 ENDPTPRIME: the transfer does not name the pages that follow its first",
                  EndpointProblem::pages_missing};
  return std::nullopt;
}

/// What is wrong with the queue head that points to it.
std::optional<Remark> fault_of_head(std::span<const std::uint8_t> head) {
  const std::uint32_t next = word(head, 2);
  if ((next & 1) != 0)
    return Remark{"USB1 ENDPTPRIME: the queue head names no transfer", EndpointProblem::no_transfer};
  if (next % kTransferBytes != 0)
    return Remark{"USB1 ENDPTPRIME: a transfer that is not aligned to 32 bytes",
                  EndpointProblem::transfer_misaligned};
  if ((word(head, 3) & kHalted) != 0)
    return Remark{"USB1 ENDPTPRIME: the queue head is halted", EndpointProblem::head_halted};
  return std::nullopt;
}

}  // namespace

std::uint32_t QueueHead::packet_size() const { return word(bytes_, 0) >> 16 & 0x7FF; }

bool QueueHead::interrupts_on_setup() const { return (word(bytes_, 0) & kInterruptOnSetup) != 0; }

bool QueueHead::ends_with_empty_packet() const { return (word(bytes_, 0) & kNoEmptyPacket) == 0; }

void QueueHead::store_setup(const std::array<std::uint8_t, 8>& packet) {
  std::copy(packet.begin(), packet.end(), bytes_.begin() + kSetupOffset);
}

bool QueueHead::load_transfer() {
  const auto refuse = [this](const Remark& fault) {
    machine_.fail(fault);
    return false;
  };
  if (const auto fault = fault_of_head(bytes_)) return refuse(*fault);
  const std::uint32_t next = word(bytes_, 2);
  const auto transfer = machine_.dma(next, kTransferBytes);
  if (transfer.empty()) return false;
  if (const auto fault = fault_of(transfer)) return refuse(*fault);
  set_word(bytes_, 1, next);
  for (std::size_t i = 0; i < 7; ++i) set_word(bytes_, 2 + i, word(transfer, i));
  return true;
}

std::uint32_t QueueHead::bytes_left() const { return length_of(word(bytes_, 3)); }

std::span<std::uint8_t> QueueHead::take(std::uint32_t bytes) {
  const std::uint32_t address = word(bytes_, 4);
  const auto data = bytes == 0 ? std::span<std::uint8_t>{} : machine_.dma(address, bytes);
  set_word(bytes_, 3, with_length(word(bytes_, 3), bytes_left() - bytes));
  set_word(bytes_, 4, address + bytes);
  return data;
}

bool QueueHead::retire() {
  const auto transfer = machine_.dma(word(bytes_, 1), kTransferBytes);
  if (transfer.empty()) return false;
  set_word(transfer, 1, with_length(word(transfer, 1) & ~kActive, bytes_left()));
  set_word(bytes_, 3, word(bytes_, 3) & ~kActive);
  return true;
}

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
  std::copy_n(bytes.begin(), into.size(), into.begin());  // copies nothing if that is not in memory
  data1_ = !data1_;
  if (head.bytes_left() == 0 || bytes.size() < head.packet_size()) retire(head);
}

void Pipe::retire(QueueHead head) {
  if (!head.retire()) return;
  primed_ = false;
  empty_packet_due_ = false;
}

bool Endpoints::enabled(int endpoint, bool in) const {
  return (in ? usb::ENDPTCTRL1_TXE : usb::ENDPTCTRL1_RXE).of(control(static_cast<std::size_t>(endpoint))) !=
         0;
}

bool Endpoints::stalled(int endpoint, bool in) const {
  return (in ? usb::ENDPTCTRL1_TXS : usb::ENDPTCTRL1_RXS).of(control(static_cast<std::size_t>(endpoint))) !=
         0;
}

void Endpoints::write_control(std::size_t number, std::uint32_t value, Machine& machine) {
  constexpr std::uint32_t kControlType = 0;
  const int endpoint = static_cast<int>(number);
  if (endpoint != 0) {
    const bool in = usb::ENDPTCTRL1_TXE.of(value) != 0, out = usb::ENDPTCTRL1_RXE.of(value) != 0;
    if ((!in && pipe(endpoint, true).primed()) || (!out && pipe(endpoint, false).primed()))
      machine.fail(
          {fmt::format("USB1 ENDPTCTRL{}: switched off with a transfer under way: flush it first", endpoint),
           EndpointProblem::transfer_under_way,
           {std::to_string(endpoint)}});
    if ((in && usb::ENDPTCTRL1_RXT.of(value) == kControlType) ||
        (out && usb::ENDPTCTRL1_TXT.of(value) == kControlType))
      machine.fail(
          {fmt::format("USB1 ENDPTCTRL{}: the direction without use is left as a control endpoint", endpoint),
           EndpointProblem::unused_direction_is_control,
           {std::to_string(endpoint)}});
    if (usb::ENDPTCTRL1_TXR.of(value) != 0) pipe(endpoint, true).begin_with_data0();
    if (usb::ENDPTCTRL1_RXR.of(value) != 0) pipe(endpoint, false).begin_with_data0();
  }
  control_[number] = value & ~(usb::ENDPTCTRL1_TXR.mask() | usb::ENDPTCTRL1_RXR.mask());
  if (endpoint == 0) control_[0] |= kAlwaysOn;
}

std::uint32_t Endpoints::primed() const {
  std::uint32_t bits = 0;
  for (int endpoint = 0; endpoint < static_cast<int>(kCount); ++endpoint)
    for (const bool in : {false, true})
      if (pipe(endpoint, in).primed()) bits |= bit_of(endpoint, in);
  return bits;
}

void Endpoints::flush(std::uint32_t bits) {
  for (int endpoint = 0; endpoint < static_cast<int>(kCount); ++endpoint)
    for (const bool in : {false, true})
      if ((bits & bit_of(endpoint, in)) != 0) pipe(endpoint, in).flush();
}

void Endpoints::take_setup() {
  control_[0] &= ~(usb::ENDPTCTRL0_RXS.mask() | usb::ENDPTCTRL0_TXS.mask());
  for (const bool in : {false, true}) pipe(0, in).take_setup();
}

}  // namespace astro::emulator
