#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/usb/descriptors.hpp"
#include "hal/usb/setup.hpp"

namespace astro::usb_device {

/// What to do with endpoint 0 after a SETUP packet.
struct Response {
  enum class Kind : std::uint8_t {
    stall,       // the request is not understood
    send,        // `data` to the host, then its zero-length answer
    receive,     // `length` bytes from the host, then on_data()
    acknowledge  // nothing but a zero-length packet to the host
  };
  Kind kind = Kind::stall;
  std::span<const std::uint8_t> data{};
  std::uint16_t length = 0;
};

/// How a serial port is set (PSTN 1.2, table 17).
struct LineCoding {
  std::uint32_t baud = 115'200;
  std::uint8_t stop_bits = 0, parity = 0, data_bits = 8;
};

/// Endpoint 0 without hardware: the state that requests read and change. The controller's driver carries out
/// the responses and the changes.
class Control {
 public:
  /// What a request has changed and the driver has to carry out once.
  struct Changes {
    bool address = false;
    bool endpoints = false;     // all endpoints but 0 are set up again, or removed
    bool closed = false;        // the last program has closed the port
    std::uint8_t unhalted = 0;  // endpoint address whose data toggle is reset; 0: none
    std::uint8_t halted = 0;    // endpoint address that stalls from now on
  };

  /// `serial_number` must outlive the object.
  void start(const Identity& identity, std::string_view serial_number) {
    identity_ = identity;
    serial_number_ = serial_number;
  }
  void on_reset();
  Response on_setup(const Setup& setup, Speed speed);
  /// The bytes of a `receive` have arrived.
  void on_data(std::span<const std::uint8_t> bytes);
  Changes take_changes();

  std::uint8_t address() const { return address_; }
  bool configured() const { return configuration_ != 0; }
  /// A program has the port open.
  bool listening() const { return configured() && (line_state_ & 1) != 0; }
  const LineCoding& line_coding() const { return coding_; }
  bool halted(std::uint8_t endpoint) const { return (halted_ & bit(endpoint)) != 0; }

 private:
  Response standard(const Setup& setup, Speed speed);
  Response of_device(const Setup& setup, Speed speed);
  Response of_interface(const Setup& setup);
  Response of_endpoint(const Setup& setup);
  Response of_class(const Setup& setup);
  Response descriptor(const Setup& setup, Speed speed);
  Response send(std::span<const std::uint8_t> all, const Setup& setup);
  Response send_small(const Setup& setup, std::uint16_t value, std::size_t bytes);
  static Response acknowledge() { return {.kind = Response::Kind::acknowledge}; }
  static bool exists(std::uint8_t endpoint);
  static std::uint8_t bit(std::uint8_t endpoint);

  Identity identity_;
  std::string_view serial_number_;
  std::uint8_t address_ = 0, configuration_ = 0, halted_ = 0;
  std::uint16_t line_state_ = 0;
  LineCoding coding_;
  Changes changes_;
  std::array<std::uint8_t, kConfigurationBytes> reply_{};
};

}  // namespace astro::usb_device
