#include "host/emulator/usb/controller.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/teensy40/registers/registers.hpp"
#include "host/emulator/core/register_names.hpp"

namespace astro::emulator {
namespace {

using namespace teensy40;

constexpr int kUsbIrq = 113;
constexpr std::uint32_t kDevice = 2, kControlType = 0;

bool writable(std::uint32_t offset) {
  static constexpr std::array kWritable{
      usb::USBCMD.value,        usb::USBSTS.value,       usb::USBINTR.value,        usb::DEVICEADDR.value,
      usb::ENDPTLISTADDR.value, usb::USBMODE.value,      usb::ENDPTSETUPSTAT.value, usb::ENDPTPRIME.value,
      usb::ENDPTFLUSH.value,    usb::ENDPTCOMPLETE.value};
  return offset >= usb::ENDPTCTRL0.value || std::ranges::find(kWritable, offset) != kWritable.end();
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
    machine_.fail("USB1 USBCMD: attached before USBMODE makes it a device");
  if (!clocked_()) machine_.fail("USB1 USBCMD: attached without its PLL or with the transceiver off");
  if (list_ == 0) machine_.fail("USB1 USBCMD: attached without queue heads (ENDPTLISTADDR)");
  if (on_bus_ || (known_ && machine_.now() - left_at_ < kNoticed))
    machine_.fail(
        "USB1 USBCMD: attached again less than 256 ms after it left the bus, which a host may miss");
  on_bus_ = known_ = true;
}

void UsbController::reset() {
  leave_bus();
  command_ = 0x0008'0000;
  status_ = enable_ = address_ = next_address_ = list_ = mode_ = setup_waiting_ = complete_ = 0;
  address_due_ = resetting_ = suspended_ = missed_reset_ = false;
  endpoint_ = {};
  endpoint_[0] = 0x0080'0080;
  queues_ = {};
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
  for (const Queue& queue : queues_) missed_reset_ |= queue.primed;
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
  if (usb::USBCMD_RS.of(value) == 0) leave_bus();
  if (usb::USBCMD_RS.of(value) != 0 && usb::USBCMD_RS.of(command_) == 0) attach();
  command_ = value;
}

void UsbController::write_endpoint(int endpoint, std::uint32_t value) {
  if (endpoint != 0) {
    const bool in = usb::ENDPTCTRL1_TXE.of(value) != 0, out = usb::ENDPTCTRL1_RXE.of(value) != 0;
    if ((!in && queue(endpoint, true).primed) || (!out && queue(endpoint, false).primed))
      machine_.fail(
          fmt::format("USB1 ENDPTCTRL{}: switched off with a transfer under way: flush it first", endpoint));
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
  if (!writable(offset)) return refuse(offset);
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
