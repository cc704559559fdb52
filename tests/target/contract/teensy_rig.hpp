#pragma once

#include <cstring>
#include <map>
#include <string>

#include "hal/interface/board.hpp"
#include "host/emulator/robot/teensy.hpp"
#include "tests/contract/rig.hpp"
#include "tests/support/programs/elf_symbols.hpp"
#include "tests/target/images/puppet.hpp"

namespace astro::target {

/// Calls the board that runs on the emulated processor, as if it ran here.
class Puppet {
 public:
  explicit Puppet(std::uint64_t seed) : teensy_(ASTRO_IMAGE_DIR "/puppet.hex", with(seed)) {
    teensy_.flash().times = {10 * emulator::kCyclesPerMicrosecond, 100 * emulator::kCyclesPerMicrosecond};
    start();
  }

  emulator::Teensy& teensy() { return teensy_; }

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
    return config;
  }
  static std::uint32_t at(const std::string& name) {
    static const auto symbols = support::elf_symbols(ASTRO_IMAGE_DIR "/puppet.elf");
    return symbols.at(name);
  }
  bool restarted() { return teensy_.word_at(at("puppet_ready")) == 0; }

  emulator::Teensy teensy_;
};

/// The board by remote: satisfies hal::Board, and each call is made on the processor.
class RemoteBoard {
 public:
  explicit RemoteBoard(Puppet& puppet) : puppet_(puppet) {}

  struct Clock {
    Puppet& puppet;
    std::uint64_t now_us() const noexcept { return puppet.call(Call::now_us); }
  };
  struct Encoders {
    Puppet& puppet;
    hal::EncoderCounts read() noexcept {
      const std::uint64_t both = puppet.call(Call::encoders);
      return {static_cast<std::int32_t>(both), static_cast<std::int32_t>(both >> 32)};
    }
  };
  struct Motors {
    Puppet& puppet;
    hal::Duty asked{};
    void drive(hal::Duty duty) noexcept {
      asked = duty;
      puppet.call(Call::drive, static_cast<std::uint16_t>(duty.left), static_cast<std::uint16_t>(duty.right));
    }
    void brake() noexcept { puppet.call(Call::brake); }
    void coast() noexcept { puppet.call(Call::coast); }
    bool fault() noexcept { return puppet.call(Call::fault) != 0; }
  };
  struct Battery {
    Puppet& puppet;
    std::int32_t millivolts() noexcept { return static_cast<std::int32_t>(puppet.call(Call::battery)); }
  };
  struct Ports {
    static constexpr int kPorts = 1;
    Puppet& puppet;
    std::size_t read(int port, std::span<std::uint8_t> into) noexcept {
      const std::size_t count =
          puppet.call(Call::read_port, number(port), static_cast<std::uint32_t>(into.size()));
      std::memcpy(into.data(), puppet.mailbox().bytes, count);
      return count;
    }
    std::size_t write(int port, std::span<const std::uint8_t> bytes) noexcept {
      std::memcpy(puppet.mailbox().bytes, bytes.data(), bytes.size());
      return puppet.call(Call::write_port, number(port), static_cast<std::uint32_t>(bytes.size()));
    }
    std::size_t room(int port) noexcept { return puppet.call(Call::room, number(port)); }

   private:
    // The serial port, the board's second; USB needs a host that enumerates it (tests/target/usb).
    static std::uint32_t number(int port) { return static_cast<std::uint32_t>(port + 1); }
  };
  struct Flash {
    static constexpr std::uint32_t kSectors = 6, kSectorBytes = 4096, kProgramBytes = 8;
    Puppet& puppet;
    bool erase(std::uint32_t sector) noexcept { return puppet.call(Call::erase, sector) != 0; }
    bool program(std::uint32_t offset, std::span<const std::uint8_t> bytes) noexcept {
      std::memcpy(puppet.mailbox().bytes, bytes.data(), bytes.size());
      return puppet.call(Call::program, offset, static_cast<std::uint32_t>(bytes.size())) != 0;
    }
    void read(std::uint32_t offset, std::span<std::uint8_t> into) noexcept {
      puppet.call(Call::read_flash, offset, static_cast<std::uint32_t>(into.size()));
      std::memcpy(into.data(), puppet.mailbox().bytes, into.size());
    }
  };
  struct System {
    Puppet& puppet;
    std::array<std::uint8_t, 16> unique_id() noexcept {
      puppet.call(Call::unique_id);
      std::array<std::uint8_t, 16> id;
      std::memcpy(id.data(), puppet.mailbox().bytes, id.size());
      return id;
    }
    std::string_view name() noexcept { return "teensy40"; }
    hal::ResetCause reset_cause() noexcept {
      return static_cast<hal::ResetCause>(puppet.call(Call::reset_cause));
    }
    void reboot() noexcept { puppet.call(Call::reboot); }
    bool enter_bootloader() noexcept {
      puppet.call(Call::enter_bootloader);
      return puppet.teensy().in_bootloader();
    }
    bool host_wants_bootloader() noexcept { return puppet.call(Call::host_wants_bootloader) != 0; }
    void feed_watchdog() noexcept { puppet.call(Call::feed_watchdog); }
  };

  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  Ports& ports() { return ports_; }
  Flash& flash() { return flash_; }
  System& system() { return system_; }
  int hold_tick() { return static_cast<int>(puppet_.call(Call::hold_tick)); }

 private:
  Puppet& puppet_;
  Clock clock_{puppet_};
  Encoders encoders_{puppet_};
  Motors motors_{puppet_};
  Battery battery_{puppet_};
  Ports ports_{puppet_};
  Flash flash_{puppet_};
  System system_{puppet_};
};

static_assert(hal::Board<RemoteBoard>);

}  // namespace astro::target
