#pragma once

#include <algorithm>
#include <cstring>

#include "hal/interface/board.hpp"
#include "tests/target/images/puppet.hpp"

/// The board, moved by a test through the mailbox. The watchdog is fed meanwhile, as the firmware would.
extern "C" {
[[gnu::used]] inline volatile std::uint32_t puppet_ready;
[[gnu::used]] inline astro::target::Mailbox puppet_mailbox;
}

namespace astro::target {

inline void answer(std::uint64_t value) {
  puppet_mailbox.answer[0] = static_cast<std::uint32_t>(value);
  puppet_mailbox.answer[1] = static_cast<std::uint32_t>(value >> 32);
}

template <hal::Board Board>
void call_ports(Board& board, Call call) {
  Mailbox& box = puppet_mailbox;
  const auto port = static_cast<int>(box.argument[0]);
  const auto bytes = std::span(box.bytes).first(box.argument[1]);
  if (call == Call::read_port) answer(board.ports().read(port, bytes));
  if (call == Call::write_port) answer(board.ports().write(port, bytes));
  if (call == Call::room) answer(board.ports().room(port));
}

template <hal::Board Board>
void call_flash(Board& board, Call call) {
  Mailbox& box = puppet_mailbox;
  const auto bytes = std::span(box.bytes).first(std::min(box.argument[1], Mailbox::kBytes));
  if (call == Call::erase) answer(board.flash().erase(box.argument[0]));
  if (call == Call::program) answer(board.flash().program(box.argument[0], bytes));
  if (call == Call::read_flash) board.flash().read(box.argument[0], bytes);
}

template <hal::Board Board>
void call_system(Board& board, Call call) {
  auto& system = board.system();
  if (call == Call::unique_id) {
    const auto id = system.unique_id();
    std::copy(id.begin(), id.end(), puppet_mailbox.bytes);
  }
  if (call == Call::reset_cause) answer(static_cast<std::uint32_t>(system.reset_cause()));
  if (call == Call::reboot) system.reboot();
  if (call == Call::enter_bootloader) answer(system.enter_bootloader());
  if (call == Call::host_wants_bootloader) answer(system.host_wants_bootloader());
  if (call == Call::feed_watchdog) system.feed_watchdog();
  if (call == Call::hold_tick) const auto hold = board.hold_tick();
}

template <hal::Board Board>
void call_motion(Board& board, Call call) {
  const Mailbox& box = puppet_mailbox;
  if (call == Call::now_us) answer(board.clock().now_us());
  if (call == Call::encoders) {
    const auto counts = board.encoders().read();
    answer(static_cast<std::uint32_t>(counts.left) | std::uint64_t{static_cast<std::uint32_t>(counts.right)}
                                                         << 32);
  }
  if (call == Call::drive)
    board.motors().drive(
        {static_cast<std::int16_t>(box.argument[0]), static_cast<std::int16_t>(box.argument[1])});
  if (call == Call::brake) board.motors().brake();
  if (call == Call::coast) board.motors().coast();
  if (call == Call::fault) answer(board.motors().fault());
  if (call == Call::battery) answer(static_cast<std::uint32_t>(board.battery().millivolts()));
  if constexpr (hal::HasGyro<Board>) {
    if (call == Call::gyro) {
      const hal::GyroReading& reading = board.gyro().read();
      std::memcpy(puppet_mailbox.bytes, &reading, sizeof(reading));
    }
  }
}

/// The whole program.
template <hal::Board Board>
[[noreturn]] void run_puppet() {
  static Board board;
  puppet_ready = 1;
  // The watchdog is fed once in so many looks at the mailbox, each a few cycles: looks are cheap to emulate, registers are not.
  constexpr std::uint32_t kLooks = 4096;
  for (std::uint32_t looks = 0;; ++looks) {
    const auto call = *const_cast<volatile Call*>(&puppet_mailbox.call);
    if (looks % kLooks == 0 || call != Call::none) board.system().feed_watchdog();
    if (call == Call::none) continue;
    asm volatile("" ::: "memory");
    call_motion(board, call);
    call_ports(board, call);
    call_flash(board, call);
    call_system(board, call);
    asm volatile("" ::: "memory");
    *const_cast<volatile Call*>(&puppet_mailbox.call) = Call::none;
  }
}

}  // namespace astro::target
