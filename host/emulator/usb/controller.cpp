#include "host/emulator/usb/controller.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/register_names.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr int kIrq = 113;
constexpr std::uint32_t kHeadBytes = 64, kTransferBytes = 32, kActive = 1U << 7, kHalted = 1U << 6;
constexpr std::uint32_t kInterruptWhenDone = 1U << 15, kInterruptOnSetup = 1U << 15, kPage = 4096;
constexpr std::uint32_t kNoEmptyPacket = 1U << 29, kDevice = 2, kControlType = 0;

std::uint32_t word(std::span<const std::uint8_t> bytes, std::size_t index) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + 4 * index, 4);
  return value;
}

void set_word(std::span<std::uint8_t> bytes, std::size_t index, std::uint32_t value) {
  std::memcpy(bytes.data() + 4 * index, &value, 4);
}

/// The first page may begin anywhere, the other four follow it.
bool names_its_pages(std::span<const std::uint8_t> transfer) {
  const std::uint32_t first = word(transfer, 2), end = first + (word(transfer, 1) >> 16 & 0x7FFF);
  for (std::uint32_t page = first / kPage + 1, n = 1; page * kPage < end; ++page, ++n)
    if (n > 4 || word(transfer, 2 + n) / kPage != page) return false;
  return true;
}

constexpr std::uint32_t bit_of(int endpoint, bool in) { return 1U << (endpoint + (in ? 16 : 0)); }

}  // namespace

UsbPhy::UsbPhy()
    : Stored({{usbphy::PWD.value, 0x001E'1C00},
              {usbphy::TX.value, 0x1006'0607},
              {usbphy::CTRL.value, 0xC020'0000}}) {}

void UsbPhy::write(std::uint32_t offset, std::uint32_t written) {
  const std::uint32_t base = offset & ~0xFU, old = value(base);
  store(base, (offset & 0xF) == 4 ? old | written : (offset & 0xF) == 8 ? old & ~written : written);
}

bool UsbPhy::ready() const {
  const std::uint32_t ctrl = value(usbphy::CTRL.value);
  return value(usbphy::PWD.value) == 0 && usbphy::CTRL_SFTRST.of(ctrl) == 0 &&
         usbphy::CTRL_CLKGATE.of(ctrl) == 0;
}

void UsbController::reset() {
  command_ = 0x0008'0000;
  status_ = enable_ = address_ = next_address_ = list_ = mode_ = setup_waiting_ = complete_ = 0;
  address_due_ = resetting_ = suspended_ = false;
  endpoint_ = {};
  endpoint_[0] = 0x0080'0080;
  queues_ = {};
}

bool UsbController::attached() const {
  return usb::USBCMD_RS.of(command_) != 0 && usb::USBMODE_CM.of(mode_) == kDevice && clocked_();
}

void UsbController::update() { machine_.set_interrupt(kIrq, (status_ & enable_) != 0); }

void UsbController::raise(std::uint32_t event) {
  status_ |= event;
  update();
}

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

void UsbController::begin_reset() {
  resetting_ = true;
  suspended_ = false;
  address_ = 0;
  address_due_ = false;
  raise(usb::USBSTS_URI(1));
}

void UsbController::end_reset(bool high_speed) {
  resetting_ = false;
  high_speed_ = high_speed;
  for (const Queue& queue : queues_)
    if (queue.primed) machine_.fail("USB1 ENDPTFLUSH: a transfer is still primed after the bus reset");
  raise(usb::USBSTS_PCI(1));
}

void UsbController::suspend() {
  suspended_ = true;
  raise(usb::USBSTS_SLI(1));
}
void UsbController::resume() {
  suspended_ = false;
  raise(usb::USBSTS_PCI(1));
}

Handshake UsbController::setup(std::uint8_t address, const std::array<std::uint8_t, 8>& bytes) {
  if (!attached() || resetting_ || address != address_) return Handshake::nothing;
  const auto queue_head = head(0, false);
  if (queue_head.empty()) return Handshake::nothing;
  std::copy(bytes.begin(), bytes.end(), queue_head.begin() + 40);
  // What was under way at endpoint 0 is cancelled, and a stall is over.
  control(0) &= ~(usb::ENDPTCTRL0_RXS.mask() | usb::ENDPTCTRL0_TXS.mask());
  for (const bool in : {false, true}) queue(0, in) = {.primed = queue(0, in).primed, .data1 = true};
  command_ &= ~usb::USBCMD_SUTW.mask();
  setup_waiting_ |= 1;
  if ((word(queue_head, 0) & kInterruptOnSetup) != 0) raise(usb::USBSTS_UI(1));
  return Handshake::ack;
}

Packet UsbController::in(std::uint8_t address, int endpoint) {
  Packet packet;
  if (!attached() || resetting_ || address != address_ || !enabled(endpoint, true)) return packet;
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
  if (!attached() || resetting_ || address != address_ || !enabled(endpoint, false))
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

void UsbController::flush(std::uint32_t bits) {
  for (int endpoint = 0; endpoint < static_cast<int>(kEndpoints); ++endpoint)
    for (const bool in : {false, true})
      if ((bits & bit_of(endpoint, in)) != 0) queue(endpoint, in).primed = false;
}

std::uint32_t UsbController::read(std::uint32_t offset) {
  if (offset == usb::USBCMD.value) return command_;
  if (offset == usb::USBSTS.value) return status_;
  if (offset == usb::USBINTR.value) return enable_;
  if (offset == usb::DEVICEADDR.value) return usb::DEVICEADDR_USBADR(address_);
  if (offset == usb::ENDPTLISTADDR.value) return list_;
  if (offset == usb::USBMODE.value) return mode_;
  if (offset == usb::PORTSC1.value)
    return usb::PORTSC1_CCS(attached()) | usb::PORTSC1_PR(resetting_) | usb::PORTSC1_HSP(high_speed_) |
           usb::PORTSC1_SUSP(suspended_);
  if (offset == usb::ENDPTSETUPSTAT.value) return setup_waiting_;
  if (offset == usb::ENDPTCOMPLETE.value) return complete_;
  if (offset == usb::ENDPTSTAT.value) {
    std::uint32_t primed = 0;
    for (int endpoint = 0; endpoint < static_cast<int>(kEndpoints); ++endpoint)
      for (const bool in : {false, true})
        if (queue(endpoint, in).primed) primed |= bit_of(endpoint, in);
    return primed;
  }
  if (offset >= usb::ENDPTCTRL0.value) return endpoint_[(offset - usb::ENDPTCTRL0.value) / 4 % kEndpoints];
  if (offset != usb::ENDPTPRIME.value && offset != usb::ENDPTFLUSH.value) refuse(offset);
  return 0;  // both are over at once
}

void UsbController::refuse(std::uint32_t offset) {
  machine_.fail(name_of(USB1.base + offset) + ": not modelled");
}

void UsbController::write_command(std::uint32_t value) {
  if (usb::USBCMD_RST.of(value) != 0) {
    reset();
    return update();
  }
  if (usb::USBCMD_RS.of(value) != 0 && usb::USBCMD_RS.of(command_) == 0) {
    if (usb::USBMODE_CM.of(mode_) != kDevice)
      machine_.fail("USB1 USBCMD: attached before USBMODE makes it a device");
    if (!clocked_()) machine_.fail("USB1 USBCMD: attached without its PLL or with the transceiver off");
    if (list_ == 0) machine_.fail("USB1 USBCMD: attached without queue heads (ENDPTLISTADDR)");
  }
  command_ = value;
}

void UsbController::write_endpoint(int endpoint, std::uint32_t value) {
  if (endpoint != 0) {
    const bool in = usb::ENDPTCTRL1_TXE.of(value) != 0, out = usb::ENDPTCTRL1_RXE.of(value) != 0;
    if ((in && usb::ENDPTCTRL1_RXT.of(value) == kControlType) ||
        (out && usb::ENDPTCTRL1_TXT.of(value) == kControlType))
      machine_.fail(
          fmt::format("USB1 ENDPTCTRL{}: the direction without use is left as a control endpoint", endpoint));
    if (usb::ENDPTCTRL1_TXR.of(value) != 0) queue(endpoint, true).data1 = false;
    if (usb::ENDPTCTRL1_RXR.of(value) != 0) queue(endpoint, false).data1 = false;
  }
  control(endpoint) = value & ~(usb::ENDPTCTRL1_TXR.mask() | usb::ENDPTCTRL1_RXR.mask());
  if (endpoint == 0) control(0) |= 0x0080'0080;
}

void UsbController::write(std::uint32_t offset, std::uint32_t value) {
  static constexpr std::array kWritable{
      usb::USBCMD.value,        usb::USBSTS.value,       usb::USBINTR.value,        usb::DEVICEADDR.value,
      usb::ENDPTLISTADDR.value, usb::USBMODE.value,      usb::ENDPTSETUPSTAT.value, usb::ENDPTPRIME.value,
      usb::ENDPTFLUSH.value,    usb::ENDPTCOMPLETE.value};
  if (offset < usb::ENDPTCTRL0.value && std::ranges::find(kWritable, offset) == kWritable.end())
    return refuse(offset);
  if (offset == usb::USBCMD.value) return write_command(value);
  if (offset == usb::USBSTS.value) status_ &= ~value;
  if (offset == usb::USBINTR.value) enable_ = value;
  if (offset == usb::USBMODE.value) mode_ = value;
  if (offset == usb::ENDPTLISTADDR.value) {
    if (value % 2048 != 0) machine_.fail("USB1 ENDPTLISTADDR: the queue heads are not aligned to 2 KB");
    list_ = value;
  }
  if (offset == usb::DEVICEADDR.value) {
    next_address_ = usb::DEVICEADDR_USBADR.of(value);
    address_due_ = usb::DEVICEADDR_USBADRA.of(value) != 0;
    if (!address_due_) address_ = next_address_;
  }
  if (offset == usb::ENDPTSETUPSTAT.value) setup_waiting_ &= ~value;
  if (offset == usb::ENDPTCOMPLETE.value) complete_ &= ~value;
  if (offset == usb::ENDPTFLUSH.value) flush(value);
  if (offset == usb::ENDPTPRIME.value) {
    if (usb::USBMODE_CM.of(mode_) != kDevice)
      machine_.fail("USB1 ENDPTPRIME: primed before USBMODE makes it a device");
    for (int endpoint = 0; endpoint < static_cast<int>(kEndpoints); ++endpoint)
      for (const bool in : {false, true})
        if ((value & bit_of(endpoint, in)) != 0) prime(endpoint, in);
  }
  if (offset >= usb::ENDPTCTRL0.value)
    write_endpoint(static_cast<int>((offset - usb::ENDPTCTRL0.value) / 4), value);
  update();
}

}  // namespace astro::emulator
