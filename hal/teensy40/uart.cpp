#include "hal/teensy40/uart.hpp"

#include <array>

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/core/interrupts.hpp"
#include "hal/teensy40/pins.hpp"

namespace astro::teensy40 {
namespace {

constexpr UartDivider kDivider = uart_divider(24'000'000, Uart::kBaud);
static_assert(kDivider.total() * Uart::kBaud == 24'000'000, "exact");

constexpr std::uint32_t kQueue = 4;  // characters in the chip, each way

// Two characters raise an interrupt, and so does an idle line after one character.
constexpr std::uint32_t kWatermarks = lpuart::WATER_RXWATER(1) | lpuart::WATER_TXWATER(1);
constexpr std::uint32_t kListening = lpuart::CTRL_TE(1) | lpuart::CTRL_RE(1) | lpuart::CTRL_RIE(1) |
                                     lpuart::CTRL_ILIE(1) | lpuart::CTRL_ORIE(1) | lpuart::CTRL_ILT(1) |
                                     lpuart::CTRL_IDLECFG(1);
constexpr std::uint32_t kSending = kListening | lpuart::CTRL_TIE(1);
// Writing ones clears these flags. Nothing is received while OR is set.
constexpr std::uint32_t kEvents = lpuart::STAT_OR.mask() | lpuart::STAT_IDLE.mask() | lpuart::STAT_NF.mask() |
                                  lpuart::STAT_FE.mask() | lpuart::STAT_PF.mask();

Uart* active = nullptr;

}  // namespace

void Uart::start() {
  active = this;
  open_gate(CCM[ccm::CCGR3], ccm::CCGR3_CG3);
  LPUART6[lpuart::CTRL].write(0);
  LPUART6[lpuart::BAUD].write(kDivider.baud_register());
  LPUART6[lpuart::FIFO].write(lpuart::FIFO_RXFE(1) | lpuart::FIFO_TXFE(1) | lpuart::FIFO_RXFLUSH(1) |
                              lpuart::FIFO_TXFLUSH(1));
  LPUART6[lpuart::WATER].write(kWatermarks);
  LPUART6[lpuart::STAT].write(kEvents);
  apply(kUartPins);
  install(irq::kLpuart6, urgency::kUart, interrupt);
  LPUART6[lpuart::CTRL].write(kListening);
}

void Uart::stop() noexcept { LPUART6[lpuart::CTRL].write(0); }

std::size_t Uart::write(std::span<const std::uint8_t> bytes) noexcept {
  const std::size_t taken = to_send_.push(bytes);
  // The interrupt disables itself when there is nothing to send, never while there is something.
  if (taken != 0) LPUART6[lpuart::CTRL].write(kSending);
  return taken;
}

void Uart::interrupt() {
  const std::uint32_t status = LPUART6[lpuart::STAT].read();
  active->receive(status);
  active->send();
  static_cast<void>(LPUART6[lpuart::STAT].read());  // so that the writes arrive before the interrupt ends
}

void Uart::receive(std::uint32_t status) {
  std::array<std::uint8_t, kQueue> bytes{};
  // The idle flag is cleared before the queue is counted. A character that comes in between is counted, or
  // sets the flag again. If the flag were cleared afterwards, a single character could wait in the queue for
  // the next one.
  LPUART6[lpuart::STAT].write(status & kEvents);
  std::size_t count = LPUART6[lpuart::WATER].get(lpuart::WATER_RXCOUNT);
  if (count > bytes.size()) count = bytes.size();
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>(LPUART6[lpuart::DATA].read());
  received_.push(std::span(bytes).first(count));
}

void Uart::send() {
  std::array<std::uint8_t, kQueue> bytes{};
  const std::size_t free = kQueue - LPUART6[lpuart::WATER].get(lpuart::WATER_TXCOUNT);
  const std::size_t count = to_send_.pop(std::span(bytes).first(free));
  for (std::size_t i = 0; i < count; ++i) LPUART6[lpuart::DATA].write(bytes[i]);
  if (to_send_.size() == 0) LPUART6[lpuart::CTRL].write(kListening);
}

}  // namespace astro::teensy40
