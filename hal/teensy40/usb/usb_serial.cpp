#include "hal/teensy40/usb/usb_serial.hpp"

#include <algorithm>

#include "hal/teensy40/clock.hpp"
#include "hal/teensy40/core/interrupts.hpp"

namespace astro::teensy40 {
namespace {

namespace controller = usb_device::controller;
using usb_device::Pipe;
using usb_device::Response;

constexpr Pipe kControlOut{0, false}, kControlIn{0, true};
constexpr std::uint32_t kBootloaderBaud = 134;
constexpr Pipe kOut{usb_device::kOutEndpoint, false}, kIn{usb_device::kInEndpoint, true};

UsbSerial* active = nullptr;

constexpr Pipe pipe_of(std::uint8_t endpoint) { return {endpoint & 0x0FU, (endpoint & 0x80) != 0}; }

}  // namespace

void UsbSerial::start(std::string_view serial_number) {
  active = this;
  control_.start(serial_number);
  install(irq::kUsb1, urgency::kUsb, interrupt);
  controller::power_down();
  stay_away();
}

void UsbSerial::detach() noexcept {
  if (!away_) controller::detach();
}

void UsbSerial::stay_away() {
  left_at_us_ = Clock().now_us();
  away_ = true;
}

void UsbSerial::come_back_in_time() {
  // A host asks a hub for changes every 255 ms at full speed and every 256 ms at high speed (USB 2.0,
  // 11.23.1: bInterval of the status endpoint, 0xFF and 0x0C). It may not notice the absence of a device that
  // is back sooner.
  constexpr std::uint64_t kNoticed_us = 300'000;
  if (!away_ || Clock().now_us() - left_at_us_ < kNoticed_us) return;
  away_ = false;
  controller::start();
}

bool UsbSerial::take_bootloader_request() noexcept {
  if (!bootloader_requested_) return false;
  bootloader_requested_ = false;
  return true;
}

void UsbSerial::interrupt() { active->handle(); }

void UsbSerial::handle() {
  const controller::Events events = controller::take_events();
  if (events.reset) reset();
  if (events.suspended) drop_output();
  asleep_ = (asleep_ || events.suspended) && !events.resumed && !events.reset;
  if (!events.transfers) return;
  usb_device::Setup setup;
  while (controller::take_setup(setup)) handle_setup(setup);
  complete(controller::take_completed());
}

void UsbSerial::reset() {
  control_.on_reset();
  const bool in_time = controller::clean_up_after_reset();
  drop_output();
  received_size_ = 0;
  received_taken_ = 0;
  bootloader_requested_ = false;
  if (in_time) return;
  // The host continues already, but this device has lost its address.
  controller::detach();
  stay_away();
}

/// Drops the bytes that have not been sent: the next program must not get them.
void UsbSerial::drop_output() {
  controller::cancel(kIn);
  to_send_.clear();
  busy_ = false;
}

void UsbSerial::handle_setup(const usb_device::Setup& setup) {
  const Response response = control_.on_setup(setup, controller::speed());
  const auto bytes = std::span(const_cast<std::uint8_t*>(response.data.data()), response.data.size());
  carry_out(control_.take_changes());
  status_stage_ = response.kind != Response::Kind::receive;
  switch (response.kind) {
    case Response::Kind::stall:
      return controller::stall_control();
    case Response::Kind::acknowledge:
      return controller::begin(kControlIn, {});
    case Response::Kind::receive:
      return controller::begin(kControlOut, std::span(control_data_).first(response.length));
    case Response::Kind::send:
      controller::begin(kControlIn, bytes);
      return controller::begin(kControlOut, {});
  }
}

void UsbSerial::carry_out(const usb_device::Control::Changes& changes) {
  if (changes.address) controller::set_address(control_.address());
  if (changes.halted != 0) controller::stall(pipe_of(changes.halted));
  if (changes.unhalted != 0) controller::unstall(pipe_of(changes.unhalted));
  if (changes.closed) drop_output();
  if (!changes.endpoints) return;
  drop_output();
  if (!control_.configured()) return controller::close_endpoints();
  controller::open_endpoints(controller::speed());
  listen();
}

void UsbSerial::listen() {
  received_size_ = 0;
  received_taken_ = 0;
  // One packet at a time, because a host may end its bytes with a full packet and send nothing after it.
  controller::begin(kOut, std::span(received_).first(usb_device::bulk_packet(controller::speed())));
}

void UsbSerial::complete(std::uint32_t pipes) {
  if ((pipes & kControlOut.bit()) != 0 && !status_stage_ && !controller::setup_waits()) {
    control_.on_data(std::span(control_data_).first(controller::moved(kControlOut)));
    if (control_.line_coding().baud == kBootloaderBaud) bootloader_requested_ = true;
    status_stage_ = true;
    controller::begin(kControlIn, {});
  }
  if ((pipes & kOut.bit()) != 0) {
    received_size_ = controller::moved(kOut);
    if (received_size_ == 0) listen();
  }
  if ((pipes & kIn.bit()) != 0) {
    busy_ = false;
    send_next();
  }
}

/// Called from the interrupt, or while the interrupt is disabled.
void UsbSerial::send_next() {
  if (busy_ || !control_.configured()) return;
  const std::size_t count = to_send_.pop(sending_);
  if (count == 0) return;
  busy_ = true;
  controller::begin(kIn, std::span(sending_).first(count));
}

std::size_t UsbSerial::read(std::span<std::uint8_t> into) noexcept {
  come_back_in_time();
  if (received_size_ == 0) return 0;
  const InterruptOff guard(irq::kUsb1);  // a bus reset in between would drop the bytes
  const std::size_t count = std::min(into.size(), received_size_ - received_taken_);
  std::copy_n(received_.begin() + static_cast<std::ptrdiff_t>(received_taken_), count, into.begin());
  received_taken_ += count;
  if (count != 0 && received_taken_ == received_size_ && control_.configured()) listen();
  return count;
}

std::size_t UsbSerial::room() const noexcept { return to_send_.room(); }

std::size_t UsbSerial::write(std::span<const std::uint8_t> bytes) noexcept {
  const InterruptOff guard(irq::kUsb1);
  if (!control_.listening() || asleep_) return bytes.size();
  const std::size_t taken = to_send_.push(bytes);
  send_next();
  return taken;
}

}  // namespace astro::teensy40
