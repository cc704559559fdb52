#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "host/emulator/core/machine.hpp"
#include "host/emulator/usb/pipe.hpp"

namespace astro::emulator {

/// The endpoints' control registers (ENDPTCTRL0 to 7), and a pipe for both directions of each.
class Endpoints {
 public:
  static constexpr std::size_t kCount = 8;

  /// The place of a direction of an endpoint in the registers that have one bit for each.
  static constexpr std::uint32_t bit_of(int endpoint, bool in) { return 1U << (endpoint + (in ? 16 : 0)); }

  std::uint32_t control(std::size_t endpoint) const { return control_[endpoint]; }
  /// The firmware writes the control register. A rule that this breaks ends the run.
  void write_control(std::size_t endpoint, std::uint32_t value, Machine& machine);
  bool enabled(int endpoint, bool in) const;
  bool stalled(int endpoint, bool in) const;

  Pipe& pipe(int endpoint, bool in) { return pipes_[index_of(endpoint, in)]; }
  const Pipe& pipe(int endpoint, bool in) const { return pipes_[index_of(endpoint, in)]; }
  /// The pipes with a transfer under way, as bits.
  std::uint32_t primed() const;
  void flush(std::uint32_t bits);
  /// A SETUP packet has come to endpoint 0: a stall ends.
  void take_setup();

 private:
  static constexpr std::size_t index_of(int endpoint, bool in) {
    return static_cast<std::size_t>(2 * endpoint + (in ? 1 : 0));
  }
  static constexpr std::uint32_t kAlwaysOn = 0x0080'0080;  // both directions of endpoint 0

  std::array<std::uint32_t, kCount> control_{kAlwaysOn};
  std::array<Pipe, 2 * kCount> pipes_{};
};

}  // namespace astro::emulator
