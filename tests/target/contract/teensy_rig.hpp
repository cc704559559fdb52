#pragma once

#include <map>
#include <string>

#include "host/emulator/robot/teensy.hpp"
#include "tests/contract/rig.hpp"
#include "tests/support/programs/elf_symbols.hpp"
#include "tests/target/contract/remote_board.hpp"

namespace astro::target {

/// Calls the board that runs on the emulated processor, as if it ran here.
class Puppet {
 public:
  static constexpr std::string_view kName = "teensy40";
  // The serial port; USB needs a host that enumerates it (tests/target/usb).
  static constexpr int kPorts = 1;
  static constexpr int port_of(int) { return 1; }
  static constexpr bool kHasGyro = true;

  explicit Puppet(std::uint64_t seed) : teensy_(ASTRO_IMAGE_DIR "/puppet.hex", with(seed)) {
    teensy_.flash().times = {10 * emulator::kCyclesPerMicrosecond, 100 * emulator::kCyclesPerMicrosecond};
    start();
  }

  emulator::Teensy& teensy() { return teensy_; }
  bool in_bootloader() { return teensy_.in_bootloader(); }

  /// Until the board has been built.
  void start() {
    if (!teensy_.run_until([&] { return teensy_.word_at(at("puppet_ready")) == 1; }, std::chrono::seconds(1)))
      throw std::runtime_error("the puppet did not start");
  }

  /// The answer of a call that has one. Time on the processor passes only in here and in pass().
  std::uint64_t call(Call call, std::uint32_t first = 0, std::uint32_t second = 0) {
    Mailbox& box = mailbox();
    box.argument[0] = first;
    box.argument[1] = second;
    box.call = call;
    teensy_.serial().hold_wire(true);
    teensy_.run_until([&] { return box.call == Call::none || teensy_.in_bootloader() || restarted(); },
                      std::chrono::seconds(2), std::chrono::microseconds(10));
    teensy_.serial().hold_wire(false);
    return box.answer[0] | std::uint64_t{box.answer[1]} << 32;
  }
  Mailbox& mailbox() {
    return *reinterpret_cast<Mailbox*>(
        teensy_.chip().memory().at(at("puppet_mailbox"), sizeof(Mailbox)).data());
  }

 private:
  static sim::Config with(std::uint64_t seed) {
    sim::Config config;
    config.seed = seed;
    config.gyro.emplace();
    return config;
  }
  static std::uint32_t at(const std::string& name) {
    static const auto symbols = support::elf_symbols(ASTRO_IMAGE_DIR "/puppet.elf");
    return symbols.at(name);
  }
  bool restarted() { return teensy_.word_at(at("puppet_ready")) == 0; }

  emulator::Teensy teensy_;
};

using TeensyBoard = RemoteBoard<Puppet>;
static_assert(hal::Board<TeensyBoard> && hal::HasGyro<TeensyBoard>);

}  // namespace astro::target
