#include "host/emulator/robot/controller.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/core/register_names.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr int kUsbIrq = 113;
constexpr std::uint32_t kDevice = 2;

bool writable(std::uint32_t offset) {
  static constexpr std::array kWritable{
      usb::USBCMD.value,        usb::USBSTS.value,       usb::USBINTR.value,        usb::DEVICEADDR.value,
      usb::ENDPTLISTADDR.value, usb::USBMODE.value,      usb::ENDPTSETUPSTAT.value, usb::ENDPTPRIME.value,
      usb::ENDPTFLUSH.value,    usb::ENDPTCOMPLETE.value};
  return offset >= usb::ENDPTCTRL0.value || std::ranges::find(kWritable, offset) != kWritable.end();
}

std::size_t endpoint_at(std::uint32_t offset) {
  return (offset - usb::ENDPTCTRL0.value) / 4 % Endpoints::kCount;
}

/// A host asks a hub for changes every 255 ms at full speed, every 256 ms at high speed (USB 2.0, 11.23.1).
constexpr Cycles kNoticed = 256'000 * kCyclesPerMicrosecond;

}  // namespace

void UsbController::leave_rom_state() { on_bus_ = known_ = true; }

void UsbController::leave_bus() {
  if (on_bus_) left_at_ = machine_.now();
  on_bus_ = false;
}

void UsbController::attach() {
  if (usb::USBMODE_CM.of(mode_) != kDevice)
    machine_.fail(
        {"USB1 USBCMD: attached before USBMODE makes it a device", UsbProblem::attached_before_device_mode});
  if (!clocked_())
    machine_.fail({"USB1 USBCMD: attached without its PLL or with the transceiver off",
                   UsbProblem::attached_without_clock});
  if (list_ == 0)
    machine_.fail({"USB1 USBCMD: attached without queue heads (ENDPTLISTADDR)",
                   UsbProblem::attached_without_queue_heads});
  if (on_bus_ || (known_ && machine_.now() - left_at_ < kNoticed))
    machine_.fail(
        {"USB1 USBCMD: attached again less than 256 ms after it left the bus, which a host may miss",
         UsbProblem::attached_again_too_soon});
  on_bus_ = known_ = true;
}

void UsbController::reset() {
  leave_bus();
  command_ = 0x0008'0000;
  status_ = enable_ = address_ = next_address_ = list_ = mode_ = setup_waiting_ = complete_ = 0;
  address_due_ = resetting_ = suspended_ = missed_reset_ = false;
  endpoints_ = {};
}

bool UsbController::attached() const {
  return plugged_ && usb::USBCMD_RS.of(command_) != 0 && usb::USBMODE_CM.of(mode_) == kDevice && clocked_();
}

void UsbController::update() { machine_.set_interrupt(kUsbIrq, (status_ & enable_) != 0); }

void UsbController::raise(std::uint32_t event) {
  status_ |= event;
  update();
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
  missed_reset_ = missed_reset_ || endpoints_.primed() != 0;
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

void UsbController::unplug() {
  plugged_ = false;
  suspended_ = true;
  raise(usb::USBSTS_PCI(1) | usb::USBSTS_SLI(1));
}

QueueHead UsbController::head(int endpoint, bool in) {
  return {machine_, list_ + QueueHead::kBytes * static_cast<std::uint32_t>(2 * endpoint + (in ? 1 : 0))};
}

bool UsbController::answers(std::uint8_t address) const {
  return attached() && !resetting_ && !missed_reset_ && address == address_;
}

Handshake UsbController::setup(std::uint8_t address, const std::array<std::uint8_t, 8>& bytes) {
  if (!answers(address)) return Handshake::nothing;
  QueueHead queue_head = head(0, false);
  if (!queue_head.exists()) return Handshake::nothing;
  queue_head.store_setup(bytes);
  // Primed transfers stay primed, but move no data until the firmware has flushed them.
  endpoints_.take_setup();
  command_ &= ~usb::USBCMD_SUTW.mask();
  setup_waiting_ |= 1;
  if (queue_head.interrupts_on_setup()) raise(usb::USBSTS_UI(1));
  return Handshake::ack;
}

Packet UsbController::in(std::uint8_t address, int endpoint) {
  if (!answers(address) || !endpoints_.enabled(endpoint, true)) return {};
  if (endpoints_.stalled(endpoint, true)) return {Handshake::stall, {}, false};
  if (!endpoints_.pipe(endpoint, true).primed() || setup_waiting_ != 0) return {Handshake::nak, {}, false};
  const Packet packet = endpoints_.pipe(endpoint, true).in(head(endpoint, true));
  note_complete(endpoint, true);
  if (endpoint == 0 && address_due_) {
    address_ = next_address_;
    address_due_ = false;
  }
  return packet;
}

Handshake UsbController::out(std::uint8_t address, int endpoint, std::span<const std::uint8_t> bytes,
                             bool data1) {
  if (!answers(address) || !endpoints_.enabled(endpoint, false)) return Handshake::nothing;
  if (endpoints_.stalled(endpoint, false)) return Handshake::stall;
  if (!endpoints_.pipe(endpoint, false).primed() || setup_waiting_ != 0) return Handshake::nak;
  if (!endpoints_.pipe(endpoint, false).expects(data1)) return Handshake::ack;
  const QueueHead queue_head = head(endpoint, false);
  if (bytes.size() > queue_head.bytes_left()) {
    machine_.fail({fmt::format("USB1: endpoint {} receives more than its transfer takes", endpoint),
                   UsbProblem::too_many_bytes,
                   {std::to_string(endpoint)}});
    return Handshake::stall;
  }
  endpoints_.pipe(endpoint, false).out(queue_head, bytes);
  note_complete(endpoint, false);
  return Handshake::ack;
}

/// Called after each packet: if it was the last of its transfer, this is reported to the firmware.
void UsbController::note_complete(int endpoint, bool in) {
  if (endpoints_.pipe(endpoint, in).primed()) return;
  complete_ |= Endpoints::bit_of(endpoint, in);
  raise(usb::USBSTS_UI(1));
}

void UsbController::prime(int endpoint, bool in) {
  if (missed_reset_)
    return machine_.fail(
        {"USB1 ENDPTPRIME: a bus reset ended with transfers primed, and the controller was not reset",
         UsbProblem::primed_without_reset});
  if (endpoints_.pipe(endpoint, in).primed())
    return machine_.fail({fmt::format("USB1 ENDPTPRIME: endpoint {} has a transfer under way", endpoint),
                          UsbProblem::transfer_under_way,
                          {std::to_string(endpoint)}});
  if (endpoint == 0 && setup_waiting_ != 0)
    return machine_.fail(
        {"USB1 ENDPTPRIME: endpoint 0 is primed while a SETUP packet waits", UsbProblem::setup_waits, {"0"}});
  if (!endpoints_.enabled(endpoint, in))
    return machine_.fail({fmt::format("USB1 ENDPTPRIME: endpoint {} is not enabled", endpoint),
                          UsbProblem::not_enabled,
                          {std::to_string(endpoint)}});
  const QueueHead queue_head = head(endpoint, in);
  if (queue_head.exists()) endpoints_.pipe(endpoint, in).prime(queue_head);
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
  if (offset == usb::ENDPTSTAT.value) return endpoints_.primed();
  if (offset >= usb::ENDPTCTRL0.value) return endpoints_.control(endpoint_at(offset));
  if (offset != usb::ENDPTPRIME.value && offset != usb::ENDPTFLUSH.value) refuse(offset);
  return 0;  // priming and flushing take no time
}

void UsbController::refuse(std::uint32_t offset) {
  machine_.fail({name_of(USB1.base + offset) + ": not modelled",
                 UsbProblem::not_modelled,
                 {name_of(USB1.base + offset)}});
}

void UsbController::write_command(std::uint32_t value) {
  if (usb::USBCMD_RST.of(value) != 0) {
    reset();
    return update();
  }
  if (usb::USBCMD_RS.of(value) == 0) leave_bus();
  if (usb::USBCMD_RS.of(value) != 0 && usb::USBCMD_RS.of(command_) == 0) attach();
  command_ = value;
}

void UsbController::write(std::uint32_t offset, std::uint32_t value) {
  if (!writable(offset)) return refuse(offset);
  if (offset == usb::USBCMD.value) return write_command(value);
  if (offset == usb::USBSTS.value) status_ &= ~value;
  if (offset == usb::USBINTR.value) enable_ = value;
  if (offset == usb::USBMODE.value) mode_ = value;
  if (offset == usb::ENDPTLISTADDR.value) {
    if (value % 2048 != 0)
      machine_.fail({"USB1 ENDPTLISTADDR: the queue heads are not aligned to 2 KB",
                     UsbProblem::queue_heads_misaligned});
    list_ = value;
  }
  if (offset == usb::DEVICEADDR.value) {
    next_address_ = usb::DEVICEADDR_USBADR.of(value);
    address_due_ = usb::DEVICEADDR_USBADRA.of(value) != 0;
    if (!address_due_) address_ = next_address_;
  }
  if (offset == usb::ENDPTSETUPSTAT.value) setup_waiting_ &= ~value;
  if (offset == usb::ENDPTCOMPLETE.value) complete_ &= ~value;
  if (offset == usb::ENDPTFLUSH.value) endpoints_.flush(value);
  if (offset == usb::ENDPTPRIME.value) {
    if (usb::USBMODE_CM.of(mode_) != kDevice)
      machine_.fail({"USB1 ENDPTPRIME: primed before USBMODE makes it a device",
                     UsbProblem::primed_before_device_mode});
    for (int endpoint = 0; endpoint < static_cast<int>(Endpoints::kCount); ++endpoint)
      for (const bool in : {false, true})
        if ((value & Endpoints::bit_of(endpoint, in)) != 0) prime(endpoint, in);
  }
  if (offset >= usb::ENDPTCTRL0.value) endpoints_.write_control(endpoint_at(offset), value, machine_);
  update();
}

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

}  // namespace astro::emulator
