#include "hal/rp2040/uart.hpp"

#include "hal/rp2040/core/cpu.hpp"
#include "hal/rp2040/core/interrupts.hpp"
#include "hal/rp2040/pins.hpp"

namespace astro::rp2040 {
namespace {

// 125 MHz / (16 * 1 MHz) = 7 + 52/64, exactly.
constexpr std::uint32_t kWhole = 7, kSixtyFourths = 52;
constexpr std::uint32_t kReceiving = uart::IMSC_RXIM(1) | uart::IMSC_RTIM(1);
constexpr std::uint32_t kSending = kReceiving | uart::IMSC_TXIM(1);

Uart* active = nullptr;

}  // namespace

void Uart::start() {
  active = this;
  wake(resets::RESET_UART0.mask());
  UART0[uart::IBRD].write(kWhole);
  UART0[uart::FBRD].write(kSixtyFourths);
  UART0[uart::LCR_H].write(uart::LCR_H_WLEN(3) | uart::LCR_H_FEN(1));        // puts the divider in force, too
  UART0[uart::IFLS].write(uart::IFLS_RXIFLSEL(2) | uart::IFLS_TXIFLSEL(2));  // at half full
  UART0[uart::CR].write(uart::CR_UARTEN(1) | uart::CR_TXE(1) | uart::CR_RXE(1));
  apply(kUartPins);
  install(irq::kUart0, urgency::kUart, interrupt);
  UART0[uart::IMSC].write(kReceiving);
}

std::size_t Uart::write(std::span<const std::uint8_t> bytes) noexcept {
  const std::size_t taken = to_send_.push(bytes);
  if (taken == 0) return 0;
  // Its interrupt tells that the queue has become half empty, not that it is. So the first bytes are sent from here.
  const InterruptOff guard(irq::kUart0);
  send();
  return taken;
}

void Uart::interrupt() {
  active->receive();
  active->send();
}

void Uart::receive() {
  std::array<std::uint8_t, 32> bytes;
  std::size_t count = 0;
  UART0[uart::ICR].write(uart::ICR_RTIC(1));
  while (count < bytes.size() && UART0[uart::FR].get(uart::FR_RXFE) == 0)
    bytes[count++] = static_cast<std::uint8_t>(UART0[uart::DR].read());
  received_.push(std::span(bytes).first(count));
}

void Uart::send() {
  UART0[uart::ICR].write(uart::ICR_TXIC(1));
  std::array<std::uint8_t, 1> byte{};
  while (UART0[uart::FR].get(uart::FR_TXFF) == 0 && to_send_.pop(byte) != 0) UART0[uart::DR].write(byte[0]);
  UART0[uart::IMSC].write(to_send_.size() != 0 ? kSending : kReceiving);
}

}  // namespace astro::rp2040
