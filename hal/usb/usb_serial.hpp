#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/base/byte_ring.hpp"
#include "hal/usb/control.hpp"
#include "hal/usb/controller.hpp"

namespace astro::usb_device {

/// The robot as a serial port on USB.
///
/// Bytes that are written while no program has the port open are dropped, because the next program must not
/// get them; so are bytes that are written while the bus is suspended or the cable is out. Bytes from a host
/// are taken when there is room; until then the host waits.
///
/// Cost    an interrupt of some microseconds for each packet; 2 KB.
template <Controller Chip>
class UsbSerial {
 public:
  /// A program has one of them. Stays off the bus for 0.3 s after every start, so that the host notices that the
  /// program before, the boot loader or the ROM has left. read() attaches it again.
  void start(const std::array<std::uint8_t, 16>& unique_id);

  // Main loop only, which must call read() regularly; none blocks.
  std::size_t read(std::span<std::uint8_t> into) noexcept;
  std::size_t write(std::span<const std::uint8_t> bytes) noexcept;
  std::size_t room() const noexcept { return to_send_.room(); }

  /// True once for each time that a host sets the baud rate which asks this kind of board for its boot loader.
  bool take_bootloader_request() noexcept;
  /// Leaves the bus for good.
  void detach() noexcept {
    if (!away_) Chip::detach();
  }

 private:
  static constexpr Pipe kControlOut{0, false}, kControlIn{0, true};
  static constexpr Pipe kOut{kOutEndpoint, false}, kIn{kInEndpoint, true};
  static constexpr Pipe pipe_of(std::uint8_t endpoint) { return {endpoint & 0x0FU, (endpoint & 0x80) != 0}; }

  static void interrupt() { active_->handle(); }
  void handle();
  void reset();
  void handle_setup(const Setup& setup);
  void stay_away();
  void come_back_in_time();
  void drop_output();
  void carry_out(const Control::Changes& changes);
  void complete(std::uint32_t pipes);
  void send_next();
  void listen();

  static inline UsbSerial* active_ = nullptr;

  Control control_;
  std::array<char, 32> serial_number_{};
  ByteRing<1024> to_send_;
  std::array<std::uint8_t, 512> sending_{}, received_{};
  std::array<std::uint8_t, 8> control_data_{};
  volatile bool busy_ = false;
  volatile std::size_t received_size_ = 0;
  std::size_t received_taken_ = 0;
  bool status_stage_ = true;
  volatile bool asleep_ = false, bootloader_requested_ = false;
  volatile bool away_ = false;  // has left the bus, so that the host forgets the device
  std::uint64_t left_at_us_ = 0;
};

template <Controller Chip>
void UsbSerial<Chip>::start(const std::array<std::uint8_t, 16>& unique_id) {
  active_ = this;
  serial_number_ = serial_number(unique_id);
  control_.start(Chip::kIdentity, {serial_number_.data(), serial_number_.size()});
  Chip::install(interrupt);
  Chip::power_down();
  stay_away();
}

template <Controller Chip>
void UsbSerial<Chip>::stay_away() {
  left_at_us_ = Chip::now_us();
  away_ = true;
}

template <Controller Chip>
void UsbSerial<Chip>::come_back_in_time() {
  // A host asks a hub for changes every 255 ms at full speed and every 256 ms at high speed (USB 2.0,
  // 11.23.1: bInterval of the status endpoint, 0xFF and 0x0C). It may not notice the absence of a device that
  // is back sooner.
  constexpr std::uint64_t kNoticed_us = 300'000;
  if (!away_ || Chip::now_us() - left_at_us_ < kNoticed_us) return;
  away_ = false;
  Chip::start();
}

template <Controller Chip>
bool UsbSerial<Chip>::take_bootloader_request() noexcept {
  if (!bootloader_requested_) return false;
  bootloader_requested_ = false;
  return true;
}

template <Controller Chip>
void UsbSerial<Chip>::handle() {
  const Events events = Chip::take_events();
  if (events.reset) reset();
  if (events.suspended) drop_output();
  asleep_ = (asleep_ || events.suspended) && !events.resumed && !events.reset;
  if (!events.transfers) return;
  Setup setup;
  while (Chip::take_setup(setup)) handle_setup(setup);
  complete(Chip::take_completed());
}

template <Controller Chip>
void UsbSerial<Chip>::reset() {
  control_.on_reset();
  const bool in_time = Chip::clean_up_after_reset();
  drop_output();
  received_size_ = 0;
  received_taken_ = 0;
  bootloader_requested_ = false;
  if (in_time) return;
  // The host continues already, but this device has lost its address.
  Chip::detach();
  stay_away();
}

/// Drops the bytes that have not been sent: the next program must not get them.
template <Controller Chip>
void UsbSerial<Chip>::drop_output() {
  Chip::cancel(kIn);
  to_send_.clear();
  busy_ = false;
}

template <Controller Chip>
void UsbSerial<Chip>::handle_setup(const Setup& setup) {
  const Response response = control_.on_setup(setup, Chip::speed());
  const auto bytes = std::span(const_cast<std::uint8_t*>(response.data.data()), response.data.size());
  carry_out(control_.take_changes());
  status_stage_ = response.kind != Response::Kind::receive;
  switch (response.kind) {
    case Response::Kind::stall:
      return Chip::stall_control();
    case Response::Kind::acknowledge:
      return Chip::begin(kControlIn, {});
    case Response::Kind::receive:
      return Chip::begin(kControlOut, std::span(control_data_).first(response.length));
    case Response::Kind::send:
      Chip::begin(kControlIn, bytes);
      return Chip::begin(kControlOut, {});
  }
}

template <Controller Chip>
void UsbSerial<Chip>::carry_out(const Control::Changes& changes) {
  if (changes.address) Chip::set_address(control_.address());
  if (changes.halted != 0) Chip::stall(pipe_of(changes.halted));
  if (changes.unhalted != 0) Chip::unstall(pipe_of(changes.unhalted));
  if (changes.closed) drop_output();
  if (!changes.endpoints) return;
  drop_output();
  if (!control_.configured()) return Chip::close_endpoints();
  Chip::open_endpoints(Chip::speed());
  listen();
}

template <Controller Chip>
void UsbSerial<Chip>::listen() {
  received_size_ = 0;
  received_taken_ = 0;
  // One packet at a time, because a host may end its bytes with a full packet and send nothing after it.
  Chip::begin(kOut, std::span(received_).first(bulk_packet(Chip::speed())));
}

template <Controller Chip>
void UsbSerial<Chip>::complete(std::uint32_t pipes) {
  if ((pipes & kControlOut.bit()) != 0 && !status_stage_ && !Chip::setup_waits()) {
    control_.on_data(std::span(control_data_).first(Chip::moved(kControlOut)));
    if (control_.line_coding().baud == Chip::kBootloaderBaud) bootloader_requested_ = true;
    status_stage_ = true;
    Chip::begin(kControlIn, {});
  }
  if ((pipes & kOut.bit()) != 0) {
    received_size_ = Chip::moved(kOut);
    if (received_size_ == 0) listen();
  }
  if ((pipes & kIn.bit()) != 0) {
    busy_ = false;
    send_next();
  }
}

/// Called from the interrupt, or while the interrupt is disabled.
template <Controller Chip>
void UsbSerial<Chip>::send_next() {
  if (busy_ || !control_.configured()) return;
  const std::size_t count = to_send_.pop(sending_);
  if (count == 0) return;
  busy_ = true;
  Chip::begin(kIn, std::span(sending_).first(count));
}

template <Controller Chip>
std::size_t UsbSerial<Chip>::read(std::span<std::uint8_t> into) noexcept {
  come_back_in_time();
  if (received_size_ == 0) return 0;
  const typename Chip::InterruptOff guard;  // a bus reset in between would drop the bytes
  const std::size_t count = std::min(into.size(), received_size_ - received_taken_);
  std::copy_n(received_.begin() + static_cast<std::ptrdiff_t>(received_taken_), count, into.begin());
  received_taken_ += count;
  if (count != 0 && received_taken_ == received_size_ && control_.configured()) listen();
  return count;
}

template <Controller Chip>
std::size_t UsbSerial<Chip>::write(std::span<const std::uint8_t> bytes) noexcept {
  const typename Chip::InterruptOff guard;
  if (!control_.listening() || asleep_) return bytes.size();
  const std::size_t taken = to_send_.push(bytes);
  send_next();
  return taken;
}

}  // namespace astro::usb_device
