#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "hal/interface/board.hpp"
#include "tests/target/images/puppet.hpp"

namespace astro::target {

/// The board by remote: satisfies hal::Board, and each call is made on the processor. `Puppet` runs the puppet image
/// (tests/target/images/puppet_program.hpp):
///   kName               the board's name
///   kPorts, port_of(n)  how many of its ports are tested; the board's number of the n-th of them
///   kHasGyro            the board has a gyro
///   call(call, a, b)    makes a call and returns its answer
///   mailbox()           the bytes that go with a call and come back
///   in_bootloader()
template <class Puppet>
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
  struct Gyro {
    Puppet& puppet;
    hal::GyroReading read() noexcept {
      puppet.call(Call::gyro);
      hal::GyroReading reading;
      std::memcpy(&reading, puppet.mailbox().bytes, sizeof(reading));
      return reading;
    }
  };
  struct Ports {
    static constexpr int kPorts = Puppet::kPorts;
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
    static std::uint32_t number(int port) { return static_cast<std::uint32_t>(Puppet::port_of(port)); }
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
    std::string_view name() noexcept { return Puppet::kName; }
    hal::ResetCause reset_cause() noexcept {
      return static_cast<hal::ResetCause>(puppet.call(Call::reset_cause));
    }
    void reboot() noexcept { puppet.call(Call::reboot); }
    bool enter_bootloader() noexcept {
      puppet.call(Call::enter_bootloader);
      return puppet.in_bootloader();
    }
    bool host_wants_bootloader() noexcept { return puppet.call(Call::host_wants_bootloader) != 0; }
    void feed_watchdog() noexcept { puppet.call(Call::feed_watchdog); }
  };

  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  Gyro& gyro() requires Puppet::kHasGyro { return gyro_; }
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
  Gyro gyro_{puppet_};
  Ports ports_{puppet_};
  Flash flash_{puppet_};
  System system_{puppet_};
};

}  // namespace astro::target
