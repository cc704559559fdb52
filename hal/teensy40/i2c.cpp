#include "hal/teensy40/i2c.hpp"

#include "hal/teensy40/core/cpu.hpp"
#include "hal/teensy40/pins.hpp"

namespace astro::teensy40 {
namespace {

// With the 24 MHz crystal: low for 34 cycles (1.4 us; the bus wants 1.3), high for 21 and some 5 of rise and filter (0.6 at
// least), together 400 kHz. Start and stop hold for 0.8 us, data change half a microsecond after the clock's edge.
constexpr std::uint32_t kTiming =
    lpi2c::MCCR0_CLKLO(33) | lpi2c::MCCR0_CLKHI(20) | lpi2c::MCCR0_SETHOLD(18) | lpi2c::MCCR0_DATAVD(12);
// Spikes below 0.1 us do not count. A bus on which nothing has moved for 150 us is free.
constexpr std::uint32_t kFilter =
    lpi2c::MCFGR2_FILTSCL(2) | lpi2c::MCFGR2_FILTSDA(2) | lpi2c::MCFGR2_BUSIDLE(3600);

constexpr std::uint32_t kRefused = lpi2c::MSR_NDF.mask();
constexpr std::uint32_t kLost = lpi2c::MSR_ALF.mask() | lpi2c::MSR_FEF.mask() | lpi2c::MSR_PLTF.mask();
constexpr std::uint32_t kEvents = lpi2c::MSR_EPF.mask() | lpi2c::MSR_SDF.mask() | kRefused | kLost;

constexpr std::uint32_t kWrites = 0, kReads = 1;  // last bit of an address on the bus
constexpr std::uint32_t kQueue = 4;
enum Command : std::uint32_t { kSend = 0, kReceive = 1, kStop = 2, kStart = 4 };

// Nine clocks: more than a sensor in the middle of a byte can wait for.
constexpr int kEdges = 18;
constexpr int kStopSteps = 4;

void queue(Command command, std::uint32_t data = 0) {
  LPI2C1[lpi2c::MTDR].write(lpi2c::MTDR_CMD(command) | lpi2c::MTDR_DATA(data));
}

// An output of 0 pulls the line down; an input lets it go.
void pull(std::uint32_t lines) { GPIO1[gpio::GDIR].modify(gpio1::kScl | gpio1::kSda, lines); }

}  // namespace

void I2c::start() {
  open_gate(CCM[ccm::CCGR1], ccm::CCGR1_CG13);
  open_gate(CCM[ccm::CCGR2], ccm::CCGR2_CG3);
  CCM[ccm::CSCDR2].modify(ccm::CSCDR2_LPI2C_CLK_PODF.mask(), ccm::CSCDR2_LPI2C_CLK_SEL(1));
  IOMUXC_GPR[iomuxc_gpr::GPR26].modify(gpio1::kScl | gpio1::kSda, 0);  // the pins belong to GPIO1
  GPIO1[gpio::DR_CLEAR].write(gpio1::kScl | gpio1::kSda);
  pull(0);
  set_up();
}

void I2c::set_up() {
  LPI2C1[lpi2c::MCR].write(lpi2c::MCR_RST(1));
  LPI2C1[lpi2c::MCR].write(0);
  LPI2C1[lpi2c::MCFGR1].write(0);  // whole clock, open drain, a stop only when it is asked for
  LPI2C1[lpi2c::MCFGR2].write(kFilter);
  LPI2C1[lpi2c::MCCR0].write(kTiming);
  apply(kI2cPins);
  LPI2C1[lpi2c::MCR].write(lpi2c::MCR_MEN(1));
}

void I2c::begin_read(std::uint8_t address, std::uint8_t from, std::uint8_t count) noexcept {
  const std::uint32_t shifted = std::uint32_t{address} << 1;
  queue(kStart, shifted | kWrites);
  queue(kSend, from);
  queue(kStart, shifted | kReads);
  queue(kReceive, count - 1U);
  wanted_ = count;
  read_ = 0;
  stop_asked_ = false;  // the queue is full
}

void I2c::begin_write(std::uint8_t address, std::uint8_t number, std::uint8_t value) noexcept {
  LPI2C1[lpi2c::MSR].write(kEvents);  // the stop of a read before
  queue(kStart, std::uint32_t{address} << 1 | kWrites);
  queue(kSend, number);
  queue(kSend, value);
  queue(kStop);
  wanted_ = read_ = 0;
  stop_asked_ = true;
}

i2c::Transfer I2c::advance() noexcept {
  using i2c::Transfer;
  if (edges_left_ != 0) [[unlikely]]
    return clock_on();
  const std::uint32_t status = LPI2C1[lpi2c::MSR].read();
  if ((status & (kRefused | kLost)) != 0) [[unlikely]] {
    LPI2C1[lpi2c::MCR].write(lpi2c::MCR_MEN(1) | lpi2c::MCR_RTF(1) | lpi2c::MCR_RRF(1));
    LPI2C1[lpi2c::MSR].write(kEvents);  // the controller itself stops a transfer that is refused
    return (status & kLost) != 0 ? Transfer::lost : Transfer::refused;
  }
  if (wanted_ != 0) return read_on();
  if (lpi2c::MSR_SDF.of(status) == 0) return Transfer::busy;
  LPI2C1[lpi2c::MSR].write(kEvents);
  return Transfer::done;
}

// The last byte is there before its stop, which needs no more looking at: a bus that hangs is noticed by the next transfer.
i2c::Transfer I2c::read_on() {
  const std::uint32_t queues = LPI2C1[lpi2c::MFSR].read();
  for (std::uint32_t left = lpi2c::MFSR_RXCOUNT.of(queues); left != 0 && read_ != wanted_; --left)
    bytes_[read_++] = static_cast<std::uint8_t>(LPI2C1[lpi2c::MRDR].read());
  if (!stop_asked_ && lpi2c::MFSR_TXCOUNT.of(queues) != kQueue) {
    stop_asked_ = true;
    queue(kStop);
  }
  return read_ == wanted_ && stop_asked_ ? i2c::Transfer::done : i2c::Transfer::busy;
}

void I2c::release() noexcept {
  LPI2C1[lpi2c::MCR].write(0);
  apply(kI2cPinsByHand);
  edges_left_ = kEdges + kStopSteps;
}

// Clocks by hand, one edge a call. The last four make a stop, data down while the clock is low, clock up, data up, and look.
i2c::Transfer I2c::clock_on() {
  constexpr std::uint32_t kBoth = gpio1::kScl | gpio1::kSda;
  --edges_left_;
  if (edges_left_ >= kStopSteps) {
    pull(edges_left_ % 2 != 0 ? gpio1::kScl : 0);
    return i2c::Transfer::busy;
  }
  if (edges_left_ != 0) {
    pull(edges_left_ == 3 ? kBoth : edges_left_ == 2 ? gpio1::kSda : 0);
    return i2c::Transfer::busy;
  }
  const bool free = (GPIO1[gpio::PSR].read() & kBoth) == kBoth;
  set_up();
  return free ? i2c::Transfer::done : i2c::Transfer::lost;
}

}  // namespace astro::teensy40
