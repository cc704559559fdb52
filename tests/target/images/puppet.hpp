#pragma once

#include <cstdint>

/// How a test on a computer calls the board on the processor: it writes a call into this mailbox, runs the
/// processor until the call is done, and reads the answer.
namespace astro::target {

enum class Call : std::uint32_t {
  none,
  now_us,
  encoders,
  drive,
  brake,
  coast,
  fault,
  battery,
  gyro,
  read_port,
  write_port,
  room,
  erase,
  program,
  read_flash,
  unique_id,
  reset_cause,
  reboot,
  enter_bootloader,
  host_wants_bootloader,
  feed_watchdog,
  hold_tick,
};

struct Mailbox {
  static constexpr std::uint32_t kBytes = 4096;
  Call call;                  // none: done
  std::uint32_t argument[2];  // port, sector, offset, size; duties
  std::uint32_t answer[2];
  std::uint8_t bytes[kBytes];
};

}  // namespace astro::target
