#include "hal/teensy40/usb/usb_serial.hpp"

#include <algorithm>

#include "hal/teensy40/interrupts.hpp"

namespace astro::teensy40 {
namespace {

namespace controller = usb_device::controller;
using usb_device::Pipe;
using usb_device::Response;

constexpr Pipe kControlOut{0, false}, kControlIn{0, true};
constexpr Pipe kOut{usb_device::kOutEndpoint, false}, kIn{usb_device::kInEndpoint, true};

UsbSerial* active = nullptr;

constexpr Pipe pipe_of(std::uint8_t endpoint) { return {endpoint & 0x0FU, (endpoint & 0x80) != 0}; }

}  // namespace

void UsbSerial::start(std::string_view serial_number, bool was_attached) {
  active = this;
  control_.start(serial_number);
  install(irq::kUsb1, urgency::kUsb, interrupt);
  controller::start(was_attached);
}

void UsbSerial::interrupt() { active->handle(); }

void UsbSerial::handle() {
  const controller::Events events = controller::take_events();
  if (events.reset) reset();
  if (!events.transfers) return;
  usb_device::Setup setup;
  while (controller::take_setup(setup)) handle_setup(setup);
  complete(controller::take_completed());
}

void UsbSerial::reset() {
  control_.on_reset();
  const bool in_time = controller::clean_up_after_reset();
  to_send_.clear();
  busy_ = false;
  received_size_ = 0;
  received_taken_ = 0;
  if (!in_time) controller::start(false);
}

void UsbSerial::handle_setup(const usb_device::Setup& setup) {
  const Response response = control_.on_setup(setup, controller::speed());
  const auto bytes = std::span(const_cast<std::uint8_t*>(response.data.data()), response.data.size());
  carry_out(control_.take_changes());
  switch (response.kind) {
    case Response::Kind::stall:
      return controller::stall_control();
    case Response::Kind::acknowledge:
      return controller::begin(kControlIn, {});
    case Response::Kind::receive:
      status_stage_ = false;
      return controller::begin(kControlOut, std::span(control_data_).first(response.length));
    case Response::Kind::send:
      status_stage_ = true;
      controller::begin(kControlIn, bytes);
      return controller::begin(kControlOut, {});
  }
}

void UsbSerial::carry_out(const usb_device::Control::Changes& changes) {
  if (changes.address) controller::set_address(control_.address());
  if (changes.halted != 0) controller::stall(pipe_of(changes.halted));
  if (changes.unhalted != 0) controller::unstall(pipe_of(changes.unhalted));
  if (!changes.configuration) return;
  if (!control_.configured()) return controller::close_endpoints();
  controller::open_endpoints(controller::speed());
  listen();
}

void UsbSerial::listen() {
  received_size_ = 0;
  received_taken_ = 0;
  controller::begin(kOut, received_);
}

void UsbSerial::complete(std::uint32_t pipes) {
  if ((pipes & kControlOut.bit()) != 0 && !status_stage_) {
    control_.on_data(std::span(control_data_).first(controller::moved(kControlOut)));
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

/// From the interrupt, or while it is held off.
void UsbSerial::send_next() {
  if (busy_ || !control_.configured()) return;
  const std::size_t count = to_send_.pop(sending_);
  if (count == 0) return;
  busy_ = true;
  controller::begin(kIn, std::span(sending_).first(count));
}

std::size_t UsbSerial::read(std::span<std::uint8_t> into) noexcept {
  const std::size_t count = std::min(into.size(), received_size_ - received_taken_);
  std::copy_n(received_.begin() + static_cast<std::ptrdiff_t>(received_taken_), count, into.begin());
  received_taken_ += count;
  if (count != 0 && received_taken_ == received_size_) {
    const InterruptOff guard(irq::kUsb1);
    if (control_.configured()) listen();
  }
  return count;
}

std::size_t UsbSerial::room() const noexcept { return to_send_.room(); }

std::size_t UsbSerial::write(std::span<const std::uint8_t> bytes) noexcept {
  if (!control_.listening()) return bytes.size();
  const std::size_t taken = to_send_.push(bytes);
  const InterruptOff guard(irq::kUsb1);
  send_next();
  return taken;
}

}  // namespace astro::teensy40
