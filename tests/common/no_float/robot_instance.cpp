#include "firmware/app/robot.hpp"

namespace {

/// The smallest board: no heap, no float of its own, so that whatever the object code shows is the
/// firmware's.
struct Board {
  struct Clock {
    std::uint64_t now_us() const noexcept { return 0; }
  };
  struct Encoders {
    astro::hal::EncoderCounts read() noexcept { return {}; }
  };
  struct Motors {
    void drive(astro::hal::Duty) noexcept {}
    void brake() noexcept {}
    void coast() noexcept {}
    bool fault() noexcept { return false; }
  };
  struct Battery {
    std::int32_t millivolts() noexcept { return 12000; }
  };
  struct Ports {
    static constexpr int kPorts = 2;
    std::size_t read(int, std::span<std::uint8_t>) noexcept { return 0; }
    std::size_t write(int, std::span<const std::uint8_t>) noexcept { return 0; }
    std::size_t room(int) noexcept { return 0; }
  };
  struct Flash {
    static constexpr std::uint32_t kSectors = 4, kSectorBytes = 4096, kProgramBytes = 4;
    bool erase(std::uint32_t) noexcept { return true; }
    bool program(std::uint32_t, std::span<const std::uint8_t>) noexcept { return true; }
    void read(std::uint32_t, std::span<std::uint8_t>) noexcept {}
  };
  struct System {
    std::array<std::uint8_t, 16> unique_id() noexcept { return {}; }
    std::string_view name() noexcept { return "none"; }
    astro::hal::ResetCause reset_cause() noexcept { return astro::hal::ResetCause::power_on; }
    void reboot() noexcept {}
    bool enter_bootloader() noexcept { return false; }
    bool host_wants_bootloader() noexcept { return false; }
    void feed_watchdog() noexcept {}
  };
  struct Hold {
    Hold() = default;
    Hold(const Hold&) = delete;
    Hold& operator=(const Hold&) = delete;
    ~Hold() {}  // NOLINT(modernize-use-equals-default): a guard that is only declared must not warn
  };

  Clock& clock() { return clock_; }
  Encoders& encoders() { return encoders_; }
  Motors& motors() { return motors_; }
  Battery& battery() { return battery_; }
  Ports& ports() { return ports_; }
  Flash& flash() { return flash_; }
  System& system() { return system_; }
  Hold hold_tick() { return {}; }

  Clock clock_;
  Encoders encoders_;
  Motors motors_;
  Battery battery_;
  Ports ports_;
  Flash flash_;
  System system_;
};
static_assert(astro::hal::Board<Board>);

}  // namespace

template class astro::Robot<Board>;
